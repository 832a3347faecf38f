"""Every word of the page exists in both languages, and every word is used. Needs no browser."""
import json
import pathlib
import re
import sys
import unittest

PAGE = pathlib.Path(__file__).resolve().parents[2] / "firmware" / "page"
WORDS = {language: json.loads((PAGE / f"words_{language}.json").read_text()) for language in ("en", "de")}
SOURCES = "\n".join(file.read_text() for file in sorted(PAGE.glob("*.js")) + [PAGE / "index.html"])

# Any text of the sources that looks like a key: keys also stand in tables of the scripts.
LITERALS = {text for text in re.findall(r"""['"]([a-z_]+(?:\.[a-z_]+)+)['"]""", SOURCES)
            if not text.endswith((".js", ".css"))}
CALLED = set(re.findall(r"""\bword\('([^']+)'""", SOURCES))
CALLED |= set(re.findall(r'data-word(?:-label)?="([^"]+)"', SOURCES))
FAMILIES = set(re.findall(r"""\bword_of\('([^']+)'""", SOURCES))
COUNTED = set(re.findall(r"""\bword_count\('([^']+)'""", SOURCES))


def is_used(key):
    counted, family = key.rsplit(".", 1)[0], key.split(".", 1)[0]
    return key in LITERALS or key in CALLED or counted in COUNTED or family in FAMILIES


class WordsTest(unittest.TestCase):
    def test_both_languages_have_the_same_keys(self):
        self.assertEqual(sorted(WORDS["en"]), sorted(WORDS["de"]))

    def test_both_languages_have_the_same_places(self):
        places = {language: {key: sorted(re.findall(r"\{\w+\}", text)) for key, text in words.items()}
                  for language, words in WORDS.items()}
        self.assertEqual(places["en"], places["de"])

    def test_no_word_is_empty(self):
        for language, words in WORDS.items():
            self.assertEqual([key for key, text in words.items() if not text.strip()], [], language)

    def test_every_key_exists(self):
        self.assertGreater(len(CALLED), 50)
        missing = {key for key in CALLED if key not in WORDS["en"]}
        forms = {f"{key}.{form}" for key in COUNTED for form in ("one", "other")}
        missing |= {key for key in forms if key not in WORDS["en"]}
        # A literal such as 'history.from' in a table is a key when its family is one.
        families = {key.split(".", 1)[0] for key in WORDS["en"]}
        missing |= {key for key in LITERALS if key.split(".")[0] in families and key not in WORDS["en"]
                    and key not in COUNTED}
        self.assertEqual(missing, set())

    def test_every_word_is_used(self):
        self.assertEqual([key for key in WORDS["en"] if not is_used(key)], [])

    def test_no_text_stands_in_the_scripts(self):
        """What people read comes from the words: element(…, 'Text') is a mistake."""
        places = r"""(?:textContent = |announce\(|element\('\w+', \{[^{}]*\}, )"""
        found = re.findall(places + r"""'([^']*[A-Za-z]{3}[^']*)'""", SOURCES)
        self.assertEqual(found, [])

    def test_codes_of_the_measurement_have_words(self):
        root = PAGE.parents[1]
        for header, family in (("core/base/status.hpp", "status"), ("core/quality/warning.hpp", "warning")):
            codes = re.findall(r"\bCODE\((\w+),", (root / header).read_text())
            self.assertGreater(len(codes), 10)
            self.assertEqual([code for code in codes if f"{family}.{code}" not in WORDS["en"]], [],
                             f"{header}: add {family}.CODE to words_en.json and words_de.json")

    def test_checks_and_verdicts_have_words(self):
        header = (PAGE.parents[1] / "core/quality/check.hpp").read_text()
        for names, family in (("kCheckNames", "check"), ("kVerdictNames", "verdict")):
            listed = re.search(names + r" =[^;]*\{([^}]*)\}", header).group(1)
            codes = re.findall(r'"(\w+)"', listed)
            self.assertGreater(len(codes), 2)
            self.assertEqual([code for code in codes if f"{family}.{code}" not in WORDS["en"]], [], names)

    def test_codes_of_the_devices_have_words(self):
        listed = re.search(r"enum class DeviceCode[^{]*\{([^}]*)\}", (PAGE.parents[1] / "drivers/device_status.hpp").read_text())
        codes = [code for code in re.findall(r"\w+", listed.group(1)) if code != "ok"]
        self.assertGreater(len(codes), 10)
        self.assertEqual([code for code in codes if f"fault.{code}" not in WORDS["en"]], [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
