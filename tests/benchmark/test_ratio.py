"""The ratio of two commands on machines whose speed changes."""

import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.dont_write_bytecode = True

import ratio  # noqa: E402


class Ratio(unittest.TestCase):
    def test_a_machine_that_slows_down_slowly_does_not_change_it(self):
        calls = []

        def measure(command):
            calls.append(command)
            speed = 1 + 0.1 * ((len(calls) - 1) // 2)  # the same for both of a pair
            return 2.5 * speed if command == "theirs" else speed, 1.0

        found = ratio.compare(["ours", "theirs"], 6, measure)
        words = ratio.in_words(found)
        self.assertIn("ratio 2.5 (", words)
        self.assertEqual(calls[:4], ["ours", "theirs", "theirs", "ours"])

    def test_ratios_that_differ_are_doubted(self):
        words = ratio.in_words([((1, 1), (2, 3)), ((1, 1), (4, 3))])
        self.assertIn("ratio 3 (2 to 4 in 2 pairs; they differ", words)
        self.assertIn("ratio 3 (3 to 3 in 2 pairs)", words)

    def test_processor_time_is_that_of_the_command(self):
        busy = [sys.executable, "-c", "import time\nwhile time.process_time() < 0.3: pass"]
        wall, processor = ratio.timed(busy)
        self.assertGreaterEqual(processor, 0.3)
        self.assertGreaterEqual(wall, 0.3)
        idle, used = ratio.timed(["sleep", "0.3"])
        self.assertGreaterEqual(idle, 0.3)
        self.assertLess(used, 0.2)

    def test_a_command_that_fails_is_named(self):
        for command in ("false", "/none/such"):
            done = subprocess.run([sys.executable, ratio.__file__, "true", command], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1), done.stderr)
            self.assertIn(command, done.stderr)


if __name__ == "__main__":
    unittest.main()
