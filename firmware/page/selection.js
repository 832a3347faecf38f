// Which item of a tray is pointed at, focused or pinned: table and drawings light it up together.

export class Selection extends EventTarget {
  constructor() {
    super();
    this.pointed = null;
    this.pinned = null;
  }

  get label() {
    return this.pointed ?? this.pinned;
  }

  point(label) {
    if (this.pointed === label) return;
    this.pointed = label;
    this.dispatchEvent(new Event('change'));
  }

  pin(label) {
    this.pinned = this.pinned === label ? null : label;
    this.dispatchEvent(new Event('change'));
  }
}
