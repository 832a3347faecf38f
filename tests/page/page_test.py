"""Runs the tests of the page in a browser. Usage: page_test.py [NAME...], such as live_test.LiveTest.test_demo_station.

Exit status 77: Chromium, its driver or Selenium is missing here. With CI=true that is a failure.
"""
import importlib.util
import os
import pathlib
import shutil
import sys
import time
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
MODULES = ["views_test", "first_steps_test", "health_test", "live_test", "tray_test", "roles_test", "history_test",
           "modules_test", "screenshots_test"]


def missing_tools():
    missing = [name for name in ("chromium", "chromedriver") if shutil.which(name) is None]
    return missing + ([] if importlib.util.find_spec("selenium") else ["python3-selenium"])


def main():
    missing = missing_tools()
    if missing:
        print("skipped: missing here:", ", ".join(missing))
        return 1 if os.environ.get("CI") == "true" else 77
    from page_case import Shared  # needs Selenium
    begun = time.monotonic()
    try:
        suite = unittest.defaultTestLoader.loadTestsFromNames(sys.argv[1:] or MODULES)
        result = unittest.TextTestRunner(verbosity=2, descriptions=False).run(suite)
    finally:
        Shared.close()
    print(f"page without the 3-D library: {Shared.page_bytes} bytes; lowest contrast: {Shared.lowest_contrast:.2f}; "
          f"{time.monotonic() - begun:.0f} s")
    return 0 if result.wasSuccessful() and result.testsRun > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
