"""What lcm-logger wrote of the bulk network is read by saker replay."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

FOLDER = pathlib.Path(__file__).parent
URL = "udpm://239.255.76.67:7668?ttl=0&recv_buf_size=2097152"  # as `saker replay` and docs/channels.md say
RECORD = '''
lcm-logger --quiet --lcm-url="$0" "$1" & logger=$!
sleep 1
"$2" --gtest_filter=WithRoute.TenScans*
sleep 1
kill -INT $logger
wait $logger || true
'''


class Logger(unittest.TestCase):
    def test_every_scan_that_was_sent_comes_back(self):
        with tempfile.TemporaryDirectory(prefix="saker_log_") as folder:
            log, out = pathlib.Path(folder, "flight.lcm"), pathlib.Path(folder, "out")
            run = subprocess.run([FOLDER / "in_namespace.sh", "bash", "-ec", RECORD, URL, log,
                                  os.environ["NETWORK_TEST"]], capture_output=True, text=True, timeout=60)
            if run.returncode == 77:
                raise unittest.SkipTest(run.stderr)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            replay = subprocess.run([os.environ["SAKER"], "replay", log, "--format", "lcm", "-o", out],
                                    capture_output=True, text=True, timeout=60)
            self.assertLess(replay.returncode, 2, replay.stderr)  # ten scans make no object
            self.assertEqual(json.loads((out / "results.json").read_text())["scans"], 10)


if __name__ == "__main__":
    unittest.main()
