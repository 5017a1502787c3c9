"""shared/completion.bash: what bash offers behind a beginning of a word: test_completion.py BUILD"""

import pathlib
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = """
source "$1/shared/completion.bash"
shift
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_spall_complete "$1" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
printf '%s\\n' "${COMPREPLY[@]}"
"""


def offered(*words):
    done = subprocess.run(["bash", "-c", SCRIPT, "bash", ROOT, *words], capture_output=True, text=True, check=True, cwd=ROOT)
    assert not done.stderr, done.stderr
    return [line for line in done.stdout.splitlines() if line]


class Completion(unittest.TestCase):
    program = None

    def test_options_are_those_of_the_program(self):
        self.assertEqual(offered(self.program, "scene.prm", "--re"), ["--restart "])
        self.assertIn("--accuracy ", offered(self.program, "--"))
        self.assertEqual(offered("shared/formulas", "--csv"), ["--csv "])

    def test_keys_are_offered_with_their_blanks_and_without_the_name_of_the_body(self):
        self.assertEqual(offered(self.program, "scene.prm", "Time/End"), ["Time/End\\ time="])
        self.assertIn("AFC/T_max=", offered(self.program, "scene.prm", "AFC/T"))
        self.assertEqual(offered(self.program, "--help", "Time/End"), ["Time/End\\ time "])

    def test_what_it_offers_the_program_takes(self):
        keys = offered(self.program, "--help", "Contact/")
        self.assertGreater(len(keys), 5)
        for key in keys[:3]:  # each is a start of the program
            done = subprocess.run(["bash", "-c", f'"$0" --help {key}', self.program], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, key)

    def test_files_are_left_to_bash_and_so_are_the_programs_of_others(self):
        self.assertEqual(offered(self.program, "data/scenes/sl"), [])
        self.assertEqual(offered(self.program, "--output", "Time"), [])
        self.assertEqual(offered("view", "--"), [])

    def test_the_installed_command_offers_its_tools(self):
        self.assertEqual(offered("shared/spall", "pen"), ["penetrate "])
        self.assertEqual(offered("shared/spall", "da"), ["data "])


if __name__ == "__main__":
    Completion.program = str(pathlib.Path(sys.argv.pop(1)) / "macro" / "penetrate")
    unittest.main()
