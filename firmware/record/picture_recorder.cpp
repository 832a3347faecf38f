#include "firmware/record/picture_recorder.hpp"

#include <ostream>

#include "firmware/check/device_check.hpp"
#include "firmware/record/recorded_files.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

constexpr Nanoseconds kWait = std::chrono::milliseconds(500);  // between two looks at the wish to stop

}  // namespace

bool record_pictures(Camera& camera, Trigger& trigger, Indicator& lamp, const PictureRecording& recording,
                     const std::atomic<bool>& stop, std::ostream& out, std::ostream& log) {
  make_output_folder(recording.out);
  const auto fail = [&log](const Device& device, DeviceStatus status) {
    log << device.description() << ": " << describe_failure(device, status).text << std::endl;
    return false;
  };
  // A lamp that fails spoils no picture.
  const auto show = [&lamp](Signal signal) {
    if (lamp.start().ok()) static_cast<void>(lamp.show(signal));
  };
  if (const DeviceStatus status = trigger.start(); !status.ok()) return fail(trigger, status);
  if (const DeviceStatus status = camera.start(); !status.ok()) return fail(camera, status);
  TakenPicture picture;
  std::uint64_t taken = 0;
  int number = 0;
  while (!stop && (recording.count == 0 || taken < recording.count)) {
    show(Signal::ready);
    Press press;
    const DeviceStatus pressed = trigger.wait_for_press(kWait, press);
    if (pressed.code() == DeviceCode::timed_out) continue;
    if (!pressed.ok()) return fail(trigger, pressed);
    show(Signal::hold_still);
    if (const DeviceStatus status = take_pictures(camera, 1, picture); !status.ok()) {
      return fail(camera, status);
    }
    std::filesystem::path file;
    do {
      file = recording.out / (four_digits(++number) + ".png");
    } while (std::filesystem::exists(file));
    write_png(file, as_rgb(picture.frame.view).frame());
    ++taken;
    out << "Saved " << file.string() << std::endl;
    trigger.discard_pending();
  }
  camera.stop();
  trigger.stop();
  lamp.stop();
  return true;
}

}  // namespace traygauge
