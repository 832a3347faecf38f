"""Documents and shapes of scans, as stations hand them over."""
import datetime
import math

EVIL = '<script>alert(1)</script><img src=x onerror=alert(2)> & "Käse" 🍲'


def item(label, volume_ml, sigma_ml=4.0, dish=1, food=None, status="ok"):
    return {"label": label, "dish": dish, "status": status, "volume_ml": volume_ml, "sigma_ml": sigma_ml,
            "food": food}


def document(number, items, station="kitchen", status="ok", message="Measured.", age_s=2, **more):
    taken = datetime.datetime.now(datetime.timezone.utc) - datetime.timedelta(seconds=age_s)
    return {"version": 2, "id": f"{station}-{number}", "station": station, "number": number,
            "taken_at": taken.strftime("%Y-%m-%dT%H:%M:%S.000Z"), "clock_synchronised": True, "supersedes": None,
            "scan": number, "tray": None, "status": status, "message": message, "items": items,
            "relative_angle_deg": 18.0, "duration_ms": 1234.5, "timing_ms": {"total": 321.0}, "warnings": [],
            "checks": [], "blur_px": [0.87, 0.91], **more}


def check(name, label, value, sigma, limit, verdict="passed"):
    return {"name": name, "label": label, "value": value, "sigma": sigma, "limit": limit, "verdict": verdict}


def checks(scale_percent=0.12):
    """Of a dish and two of its items; one has no points to compare, one is no check that the page knows."""
    return [check("dish_slip_mm", 1, 0.05, 0.21, 0.75), check("scale_percent", 1, scale_percent, 0.24, 1.0),
            check("dish_height_mm", 1, -1.31, 0.24, 1.0, "warned"), check("item_slip_mm", 2, 0, 0, 0.25),
            check("item_foot_mm", 3, -1.6, 0, 0.75, "refused"), check("brand_new_mm", 1, 0.5, 0.1, 1.0)]


def meal(number, **more):
    return document(number, [item(2, 142.4, 5.1, food="Rice"), item(3, 88.0, 3.2, food="Chicken curry"),
                             item(4, 61.3, 2.4, food="Green beans")], **more)


def unchecked(number):
    """As stations measured before they told of checks."""
    old = meal(number)
    del old["checks"], old["blur_px"]
    return old


def drifting(number):
    """Its card makes everything too large, and its plates are deeper than described, but by too little to be refused."""
    glaze = check("glaze_height_mm", 1, 0.62, 0.2, 1.0)
    return meal(number, checks=[*checks(scale_percent=0.72 + 0.01 * (number % 5)), glaze])


def forty_items(number):
    return document(number, [item(label, 10.0 + label, 1.5, food=f"Food {label}") for label in range(2, 42)])


def doubtful(number):
    """Odd names, an item without a volume, warnings, a clock that nobody synchronised, a weak power supply."""
    items = [item(2, 142.4, 5.1, food=EVIL), item(3, None, None, status="item_textureless")]
    warnings = [{"code": "items_doubtful", "message": "Doubtful.", "label": None},
                {"code": "item_uncertain", "message": "Uncertain.", "label": 2},
                {"code": "brand_new", "message": "Something <b>new</b>.", "label": None}]
    return document(number, items, status="partial", warnings=warnings, clock_synchronised=False, tray=EVIL,
                    board={"temperature_c": 71.5, "under_voltage": True})


def refused(number):
    return document(number, [], status="card_not_found", message="The reference card was not found.")


def _heap(x, y, centre, radius, height):
    distance = math.hypot(x - centre[0], y - centre[1]) / radius
    return height * (1 - distance**2) ** 0.6 if distance < 1 else 0.0


def shape(number, station="kitchen", cell=2.0, columns=130, rows=128):
    """A plate with three heaps, labels 2 to 4; most of one row is not known."""
    heaps = {2: ((-45, 20), 46, 38), 3: ((48, 26), 42, 30), 4: ((2, -52), 38, 22)}
    surface, inner, labels = [], [], []
    for row in range(rows):
        for column in range(columns):
            x, y = (column - columns / 2) * cell, (row - rows / 2) * cell
            from_centre = math.hypot(x, y)
            if from_centre > 125:
                surface.append(None), inner.append(None), labels.append(0)
                continue
            bottom = 4 + 18 * max(0, (from_centre - 75) / 50) ** 1.5
            label, height = 0, 0.0
            for candidate, (centre, radius, top) in heaps.items():
                found = _heap(x, y, centre, radius, top)
                if found > height:
                    label, height = candidate, found
            is_known = not (row == 40 and column % 3)
            surface.append(round(10 * (bottom + height)) if is_known else None)
            inner.append(round(10 * bottom))
            labels.append(label)
    outlines = [{"label": label, "dish": 1, "points_mm": [
        [centre[0] + radius * math.cos(step / 20 * math.pi), centre[1] + radius * math.sin(step / 20 * math.pi)]
        for step in range(40)]} for label, (centre, radius, _) in heaps.items()]
    return {"id": f"{station}-{number}",
            "dishes": [{"dish": 1, "cell_mm": cell, "columns": columns, "rows": rows,
                        "origin_mm": [-columns / 2 * cell, -rows / 2 * cell], "surface_tenth_mm": surface,
                        "inner_tenth_mm": inner, "labels": labels}],
            "outlines": outlines}
