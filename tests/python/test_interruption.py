"""Ctrl-C ends long work soon, which also reports progress and leaves other threads running."""

import os
import signal
import subprocess
import sys
import threading
import time
import unittest

from support import ROBOT, data

import capstan

PROGRAM = """
import sys, time
import capstan
work = {work}
began = []
def progress(share, doing):
    if not began:
        began.append(1)
        print("began", flush=True)
try:
    work(progress)
    print("ended", flush=True)
except KeyboardInterrupt:
    print("interrupted", flush=True)
sys.stdin.read()
"""

#: Work of many seconds, and the time until Ctrl-C after its first progress [s].
WORK = {
    "track": (f"lambda p: [capstan.track({data('tips.csv')!r}, progress=p) for _ in range(50)]", 0.3),
    "identify": (f"lambda p: capstan.identify([{data('tips.capstan')!r}, {data('sinusoid.capstan')!r}], progress=p)", 1.0),
    "diagnose": (f"lambda p: capstan.diagnose({data('sinusoid.csv')!r}, {ROBOT!r}, progress=p)", 1.0),
    "learn": (f"lambda p: capstan.learn({data('poses.csv')!r}, progress=p)", 1.0),
}


def cpu_seconds(process):
    """Computing time of a process until now."""
    with open(f"/proc/{process.pid}/stat") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def interrupted_after(work, wait):
    """Seconds from SIGINT to the end of a process that does `work`, its computing time meanwhile, and its output."""
    process = subprocess.Popen([sys.executable, "-c", PROGRAM.format(work=work)], stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE, text=True)
    first = process.stdout.readline()
    time.sleep(wait)
    computed, sent = cpu_seconds(process), time.monotonic()
    process.send_signal(signal.SIGINT)
    rest = process.stdout.readline()
    spent, computed = time.monotonic() - sent, cpu_seconds(process) - computed
    return spent, computed, first + rest + process.communicate()[0]


class Interruption(unittest.TestCase):
    def test_ctrl_c_ends_long_work(self):
        for name, (work, wait) in WORK.items():
            with self.subTest(name):
                spent, computed, output = interrupted_after(work, wait)
                print(f"{name}: ended {spent:.3f} s after Ctrl-C ({computed:.2f} s of computing)")
                self.assertEqual(output, "began\ninterrupted\n")
                self.assertLess(min(spent, computed), 5.0)  # far less than the work; the printed time is what it took

    def test_an_exception_of_the_progress_function_ends_the_work(self):
        class Enough(Exception):
            pass

        def progress(share, doing):
            raise Enough(doing)

        with self.assertRaises(Enough):
            capstan.identify(data("sinusoid.capstan"), progress=progress)

    def test_progress_rises_to_the_end(self):
        shares = []
        capstan.track(data("images.capstan"), progress=lambda share, doing: shares.append((share, doing)))
        self.assertTrue(shares)
        self.assertEqual(shares, sorted(shares))
        self.assertEqual({doing for _, doing in shares}, {"tracking"})

    def test_other_threads_run_meanwhile(self):
        count, stop = [0], threading.Event()

        def other():
            while not stop.wait(0.001):
                count[0] += 1

        thread = threading.Thread(target=other)
        thread.start()
        capstan.track(data("images.capstan"))
        stop.set()
        thread.join()
        self.assertGreater(count[0], 20)

    def test_two_threads_track_at_once(self):
        results = [None, None]

        def work(i):
            results[i] = capstan.track(data("images.capstan"), estimates=False).report

        threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(results[0], results[1])


if __name__ == "__main__":
    unittest.main()
