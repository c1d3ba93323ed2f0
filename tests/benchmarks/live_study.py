#!/usr/bin/python3
"""The live path against real programs: a recording is played as a robot and two cameras, another process tracks it live.

    live_study.py [--seconds 60] [--only rows tcp ros window streams file hd faults]

rows     rows over TCP
tcp      rows over TCP, images of two network cameras
ros      the same as ROS topics (needs rosmaster), then the master is killed and started again
window   the same as ros in the window (live_window), which records: needs xvfb-run, too
streams  images relayed by two ffmpeg processes (needs ffmpeg)
file     rows over TCP, images of one side-by-side video file
hd       rows over TCP and two network cameras of 1280 × 720 at 30 frames/s, recorded: processor time, lost samples; their
         JPEG images are made beforehand, as cameras make theirs on no processor of this computer (needs ffmpeg)
faults   every fault of `play`: what is said and when, what the estimate does

Every case prints the live estimates beside those of the recording tracked directly. Latency is the time from when a row
was due at the sender to when its estimate was read by this program; all processes share the clock of this computer.
Everything stays on the loopback interface.
"""
import argparse
import csv
import io
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

import numpy as np

import jpeg_cameras

ROOT = pathlib.Path(__file__).resolve().parents[2]
LATENCY = 0.04  # of the simulated cameras, from exposure to arrival [s]
FAULT_AT, FAULT_FOR, FAULT_SESSION = 15.0, 2.0, 24.0  # [s]
FAULTS = [
    ("--fault", "drop:0.01"), ("--fault", "repeat:0.01"), ("--fault", "jitter:0.02"),
    ("--fault", "silence:2@15"), ("--fault", "freeze:2@15"), ("--fault", "step:0.5@15"), ("--fault", "step:-0.5@15"),
    ("--fault", "garbage@15"),
    ("--video-fault", "drop:0.1"), ("--video-fault", "jitter:0.02"), ("--video-fault", "silence:2@15"),
    ("--video-fault", "freeze:2@15"), ("--video-fault", "swap:2@15")]


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class Lines:
    """Lines of a pipe with the times at which they were read."""

    def __init__(self, pipe):
        self.lines = []
        self.thread = threading.Thread(target=self.read, args=(pipe,), daemon=True)
        self.thread.start()

    def read(self, pipe):
        for line in pipe:
            self.lines.append((time.time(), line.rstrip("\n")))


class Table:
    """Estimates: columns by name, NaN where a cell is empty."""

    def __init__(self, text):
        rows = list(csv.reader(io.StringIO(text)))
        self.names, rows = rows[0], [r for r in rows[1:] if len(r) == len(rows[0])]
        self.gate = np.array([r[self.names.index("gate")] for r in rows])
        self.cells = {n: np.array([float(r[k]) if r[k] else np.nan for r in rows])
                      for k, n in enumerate(self.names) if n != "gate"}

    def __getitem__(self, name):
        return self.cells[name]

    def joints(self, name, rows=slice(None)):
        return np.stack([self.cells[f"{name}{k}"][rows] for k in (1, 2, 3)], 1)


class Laboratory:
    def __init__(self, cli, folder, seconds, cameras_scale=None):
        self.cli, self.folder, self.seconds = cli, folder, seconds
        truth = (ROOT / "resources/truth/default.yaml").read_text().replace("rate: 15  # 1/s", "rate: 30  # 1/s")
        (folder / "truth.yaml").write_text(truth)
        self.cameras = self.make_cameras(cameras_scale) if cameras_scale else ROOT / "resources/cameras"
        self.run("simulate", "--duration", seconds, "--truth", folder / "truth.yaml", "--cameras", self.cameras, "--out",
                 folder / "trial.capstan")
        self.run("track", folder / "trial.capstan", "--out", folder / "direct.csv", "--save-registration",
                 folder / "registration.yaml")
        self.direct = Table((folder / "direct.csv").read_text())

    def make_cameras(self, scale):
        """The cameras of the resources with more pixels: 640 × 480 by `scale`, and wider, 16 : 9."""
        at = self.folder / "cameras"
        at.mkdir()
        height = round(480 * scale)
        width = round(height * 16 / 9)
        for eye in ("left", "right"):
            text = (ROOT / f"resources/cameras/{eye}.yaml").read_text()
            text = text.replace("image_width: 640", f"image_width: {width}").replace("image_height: 480", f"image_height: {height}")
            for name in ("camera_matrix", "projection_matrix"):
                head, data, tail = re.split(rf"({name}:\n.*\n.*\n  data: \[.*\])", text)
                before, numbers = data[:-1].split("[")
                numbers = [float(number) * scale for number in numbers.split(",")]
                numbers[2] += 0.5 * (width - 640 * scale)
                numbers[-2 if len(numbers) == 12 else -1] = 1.0
                text = f"{head}{before}[{', '.join(map(repr, numbers))}]{tail}"
            (at / f"{eye}.yaml").write_text(text)
        return at

    def run(self, *arguments):
        """Runs a command of capstan-cli; returns its standard output."""
        return subprocess.run([self.cli, *map(str, arguments)], check=True, stdout=subprocess.PIPE, text=True).stdout

    def setup(self, motors, left="", right="", layout="two", latency=LATENCY, calibration=None):
        text = f"title: study\nmotors:\n  from: {motors}\n"
        if motors.startswith("ros"):
            text += "  encoders: /arm/encoders/measured_js\n"
        if left:
            text += (f"cameras:\n  left: {left}\n  layout: {layout}\n  latency: {latency}\n"
                     f"  calibration: {calibration or self.cameras}\n"
                     f"  registration: {self.folder / 'registration.yaml'}\n")
            text += f"  right: {right}\n" if right else ""
        path = self.folder / "setup.yaml"
        path.write_text(text)
        return path


class Session:
    """`track --live` in a process of its own."""

    def __init__(self, lab, setup, env=None):
        self.json = lab.folder / "live.json"
        self.json.unlink(missing_ok=True)
        self.process = subprocess.Popen(self.command(lab, setup), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, env=env)
        self.estimates, self.notices = Lines(self.process.stdout), Lines(self.process.stderr)
        deadline = time.time() + 60
        while not any("waiting for rows" in line for _, line in self.notices.lines):
            if time.time() > deadline or self.process.poll() is not None:
                raise SystemExit("the live session did not start: " + repr(self.notices.lines))
            time.sleep(0.01)

    def command(self, lab, setup):
        return [lab.cli, "track", "--live", setup, "--out", "-", "--json", self.json]

    def stop(self):
        self.process.send_signal(signal.SIGINT)

    def read(self):
        self.table = Table("\n".join(line for _, line in self.estimates.lines))
        self.read_at = np.array([t for t, _ in self.estimates.lines[1:]])[:len(self.table.gate)]

    def end(self):
        time.sleep(0.5)
        self.stop()
        self.process.wait(60)
        self.estimates.thread.join(), self.notices.thread.join()
        self.report = json.loads(self.json.read_text())
        self.read()
        self.said = [(t, line) for t, line in self.notices.lines if "receiving" in line or "silent" in line or "used" in line
                     or "frozen" in line or "stepped" in line or "refused" in line or ": waiting" in line]


class RecordedSession:
    """`record --live` in a process of its own."""

    def __init__(self, lab, setup):
        self.report, self.out = lab.folder / "record.json", lab.folder / "live.capstan"
        self.out.unlink(missing_ok=True)
        self.process = subprocess.Popen([lab.cli, "record", "--live", setup, "--out", self.out, "--json", self.report],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.notices = Lines(self.process.stderr)
        while not self.out.exists() and self.process.poll() is None:
            time.sleep(0.01)
        time.sleep(1.0)  # the robot is started when the session is there

    def end(self):
        """Returns what the process used."""
        time.sleep(0.5)
        self.process.send_signal(signal.SIGINT)
        return os.wait4(self.process.pid, 0)[2]


class WindowSession(Session):
    """The window in a display of its own. It records; an estimate's time is that at which the filter gave it."""

    def command(self, lab, setup):
        self.out, self.record = lab.folder / "window.csv", lab.folder / "recordings"
        shutil.rmtree(self.record, ignore_errors=True)
        self.record.mkdir()
        return ["xvfb-run", "-a", "-s", "-screen 0 1600x1000x24 -noreset", lab.window, setup, "--out", self.out, "--json",
                self.json, "--record", self.record]

    def stop(self):
        self.process.stdin.close()

    def read(self):
        self.table = Table(self.out.read_text())
        self.read_at = self.table["read_at"]


def play(lab, *arguments, env=None):
    """Starts `play`; its answer is in play.json at its end."""
    return subprocess.Popen([lab.cli, "play", str(lab.folder / "trial.capstan"), "--json", str(lab.folder / "play.json"),
                             *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=env)


def played(lab):
    return json.loads((lab.folder / "play.json").read_text())


def rms(values):
    return np.sqrt(np.nanmean(np.square(values), axis=0)) * 1e3


def median(values):
    return np.nanmedian(np.abs(values), axis=0) * 1e3


def say_rms(what, values):
    print(f"  {what:34s} {values[0]:8.3f} mrad {values[1]:8.3f} mrad {values[2]:8.4f} mm")


def compare(lab, session, sent):
    """Prints the live estimates beside those of the recording."""
    table, direct = session.table, lab.direct
    motors, others = table["camera"] == 0, direct["camera"] == 0
    sides = {side["side"]: side for side in session.report["live"]}
    for side in sides.values():
        print(f"  {side['side']:8s} received {side['received']}, dropped {side['dropped']}, repeated {side['repeated']}, "
              f"unpaired {side['unpaired']}, frozen {side['frozen']}; arrival to estimate median "
              f"{1e3 * side['latency']['median']:.2f} ms, 99 % {1e3 * side['latency']['p99']:.2f} ms")
    print(f"  rows sent {sent['sent']}, tracked {motors.sum()}; pairs sent {sent.get('images', {}).get('sent', 0)}, "
          f"tracked {(table['camera'] != 0).sum()}")
    if sent.get("images") and "gates" in session.report:
        print(f"  camera samples by gate {session.report['gates']}, too late {session.report['late_dropped']}")
    whole = slice(round(0.1 * motors.sum()), None)
    say_rms("RMS error of the UKF, live", rms((table.joints("q_ukf", motors) - table.joints("q", motors))[whole]))
    say_rms("RMS error of the UKF, recording", rms((direct.joints("q_ukf", others) - direct.joints("q", others))[whole]))
    if motors.sum() == others.sum():
        difference = (table.joints("q_ukf", motors) - direct.joints("q_ukf", others))[whole]
        say_rms("RMS of live − recording", rms(difference))
        say_rms("median |live − recording|", median(difference))
    due = sent["started"] + table["t"][motors] - table["t"][motors][0]
    late = 1e3 * (session.read_at[motors] - due)
    print(f"  due (its stamp) to estimate        median {np.median(late):.2f} ms, 99 % {np.quantile(late, 0.99):.2f} ms")


def network_setup(lab, port, images):
    at = f"http://127.0.0.1:{images}"
    return lab.setup(f"tcp://127.0.0.1:{port}", f"{at}/left", f"{at}/right", latency=0)  # stamps are exposures


def rows_only(lab):
    """rows over TCP"""
    port = free_port()
    session = Session(lab, lab.setup(f"tcp://127.0.0.1:{port}"))
    play(lab, "--to", f"tcp://127.0.0.1:{port}").wait()
    session.end()
    compare(lab, session, played(lab))


def over_tcp(lab):
    """rows over TCP, two network cameras"""
    port, images = free_port(), free_port()
    session = Session(lab, network_setup(lab, port, images))
    play(lab, "--to", f"tcp://127.0.0.1:{port}", "--video", f"http://127.0.0.1:{images}").wait()
    session.end()
    compare(lab, session, played(lab))


def over_ros(lab, begin=Session):
    """ROS topics"""
    env = dict(os.environ, ROS_MASTER_URI=f"http://127.0.0.1:{free_port()}", ROS_HOSTNAME="127.0.0.1", ROS_IP="127.0.0.1")
    master = [shutil.which("rosmaster"), "--core", "-p", env["ROS_MASTER_URI"].rsplit(":", 1)[1]]
    start = lambda: subprocess.Popen(master, env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    core = start()
    time.sleep(2)
    setup = lab.setup("ros:/arm/actuators/measured_js", "ros:/stereo/left/image_raw", "ros:/stereo/right/image_raw",
                      calibration=ROOT / "resources/cameras", latency=0)  # stamps are exposures
    session = begin(lab, setup, env)
    started = time.time()
    playing = play(lab, "--to", "ros", env=env)
    playing.wait()
    spent = time.time() - started
    session.end()
    compare(lab, session, played(lab))
    if begin is WindowSession:
        say_recorded(lab, session, spent)
    # The master is killed and another one started while a second recording plays.
    session = begin(lab, setup, env)
    core.terminate(), core.wait()
    time.sleep(1)
    core = start()
    restarted = time.time()
    playing = play(lab, "--to", "ros", env=env)
    while not any("motors receiving" in line for _, line in session.notices.lines) and time.time() < restarted + 30:
        time.sleep(0.01)
    first = [t for t, line in session.notices.lines if "motors receiving" in line]
    print(f"  master killed and started again: rows of a robot that starts then come {first[0] - restarted:.2f} s after it"
          if first else "  master killed and started again: no rows within 30 s")
    playing.terminate(), playing.wait()
    session.end()
    core.terminate(), core.wait()


def say_recorded(lab, session, spent):
    """Prints what the window has recorded, and its recording tracked again beside the original."""
    recorder = session.report["recorder"]
    print(f"  recorded {recorder['written']} samples, {recorder['dropped'] + recorder['lost']} lost; processor time of the window "
          f"{session.report['processor'] / spent:.2f} cores; load average {os.getloadavg()[0]:.1f}")
    for recording in session.record.glob("*.capstan"):
        lab.run("track", recording, "--out", lab.folder / "again.csv")
        again, direct = Table((lab.folder / "again.csv").read_text()), lab.direct
        motors, others = again["camera"] == 0, direct["camera"] == 0
        if motors.sum() == others.sum():
            whole = slice(round(0.1 * motors.sum()), None)
            difference = (again.joints("q_ukf", motors) - direct.joints("q_ukf", others))[whole]
            say_rms("RMS of its recording − recording", rms(difference))
            say_rms("median |its recording − recording|", median(difference))


def in_the_window(lab):
    """ROS topics, in the window, recorded"""
    over_ros(lab, WindowSession)


def jpeg_recording(lab):
    """The recording as rows and JPEG images of both cameras."""
    both, table = lab.folder / "both.mkv", lab.folder / "trial.csv"
    lab.run("convert", lab.folder / "trial.capstan", both), lab.run("convert", lab.folder / "trial.capstan", table)
    for eye, at in (("left", "0"), ("right", "iw/2")):
        subprocess.run(["ffmpeg", "-loglevel", "error", "-i", both, "-vf", f"crop=iw/2:ih:{at}:0", "-q:v", "2",
                        lab.folder / f"{eye}_%05d.jpg"], check=True)
    header, *rows = table.read_bytes().splitlines(keepends=True)
    images = lab.direct["camera"] != 0
    return jpeg_cameras.Recording(lab.folder, lab.direct["t_cam"][images], lab.direct["t"][images],
                                  [float(row.split(b",", 1)[0]) for row in rows], rows, header)


def in_hd(lab):
    """rows over TCP, two network cameras of 1280 × 720, recorded"""
    port, images = free_port(), free_port()
    recording = jpeg_recording(lab)
    senders = jpeg_cameras.Senders(recording, images, port)
    os.sync()  # the disk is still writing what was prepared
    session = RecordedSession(lab, network_setup(lab, port, images))
    started = time.time()
    player = senders.go()
    spent = time.time() - started
    used = session.end()
    result = json.loads(session.report.read_text())
    for side in result["live"]:
        print(f"  {side['side']:8s} received {side['received']}, missing {side['missing']}, dropped {side['dropped']}, "
              f"unpaired {side['unpaired']}, frozen {side['frozen']}; arrival to estimate median "
              f"{1e3 * side['latency']['median']:.2f} ms, 99 % {1e3 * side['latency']['p99']:.2f} ms")
    print(f"  rows sent {len(recording.rows)}, images sent {senders.sent[0]} left and {senders.sent[1]} right; recorded {result['motor']} rows "
          f"and {result['frames']} pairs, in all {result['written']} samples, {result['dropped'] + result['lost']} lost, "
          f"{result['bytes'] / 1e6:.0f} MB")
    print(f"  processor time: session {(used.ru_utime + used.ru_stime) / spent:.2f} cores (decoding, tracking, recording), senders "
          f"{(player.ru_utime + player.ru_stime) / spent:.2f}; load average {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


def relay(source, port):
    """ffmpeg reads a network camera, encodes its images again and serves them."""
    return subprocess.Popen([shutil.which("ffmpeg"), "-loglevel", "quiet", "-fflags", "nobuffer", "-probesize", "200000",
                             "-analyzeduration", "0", "-f", "mpjpeg", "-i", source, "-c:v", "mjpeg", "-q:v", "2", "-f",
                             "mpjpeg", "-flush_packets", "1", "-listen", "1", f"http://127.0.0.1:{port}/"],
                            stdin=subprocess.DEVNULL)


def relayed(lab, latency, begin):
    """A session of `begin` while two ffmpeg processes relay the images."""
    port, images, left, right = (free_port() for _ in range(4))
    setup = lab.setup(f"tcp://127.0.0.1:{port}", f"http://127.0.0.1:{left}/", f"http://127.0.0.1:{right}/", latency=latency)
    session = begin(lab, setup)
    playing = play(lab, "--to", f"tcp://127.0.0.1:{port}", "--video", f"http://127.0.0.1:{images}")
    time.sleep(0.5)
    relays = [relay(f"http://127.0.0.1:{images}/{eye}", at) for eye, at in (("left", left), ("right", right))]
    playing.wait()
    session.end()
    for process in relays:
        process.terminate(), process.wait()
    return session


def over_ffmpeg(lab):
    """rows over TCP, two streams of ffmpeg, whose latency is found in a recording first"""
    recording = relayed(lab, 0.0, RecordedSession)
    found = lab.run("identify", recording.out, "--parameters", "r_l1", "--method", "dual-ukf", "--json", "-")
    latency = json.loads(found)["dual_ukf"]["camera"]["delay"]
    print(f"  latency of the relays by identify, from a recording: {1e3 * latency:.0f} ms")
    compare(lab, relayed(lab, latency, Session), played(lab))


def from_file(lab):
    """rows over TCP, one side-by-side video file"""
    port, video = free_port(), lab.folder / "both.mkv"
    said = subprocess.run([lab.cli, "convert", lab.folder / "trial.capstan", video], check=True, capture_output=True, text=True)
    first = float(re.search(r"the first ([-\d.]+) s after", said.stdout + said.stderr)[1])
    session = Session(lab, lab.setup(f"tcp://127.0.0.1:{port}", video, layout="side_by_side", latency=-first))
    play(lab, "--to", f"tcp://127.0.0.1:{port}").wait()
    session.end()
    compare(lab, session, played(lab))


def faults(lab):
    """every fault of `play`"""
    print(f"  {'fault':26s} {'what is said':48s} {'after':>6s} {'back':>6s}   {'camera samples in it':26s} "
          "largest error 3 s before | in it | 3 s after [mrad, mrad, mm]   again after")
    for option, fault in FAULTS:
        port, images = free_port(), free_port()
        session = Session(lab, network_setup(lab, port, images))
        play(lab, "--to", f"tcp://127.0.0.1:{port}", "--video", f"http://127.0.0.1:{images}", option, fault).wait()
        session.end()
        one_fault(lab, session, played(lab), fault, "images" if "video" in option else "rows")


def errors_of(lab, session, fault):
    """Distances of the estimates from the joint encoders; those of the recording where the rows' own are frozen."""
    table = session.table
    truth = table.joints("q")
    if "freeze" in fault:
        motors = lab.direct["camera"] == 0
        t = table["t"] - table["t"][0] + lab.direct["t"][0]
        truth = np.stack([np.interp(t, lab.direct["t"][motors], q) for q in lab.direct.joints("q", motors).T], 1)
    return np.abs(table.joints("q_ukf") - truth) * 1e3


def one_fault(lab, session, sent, fault, of):
    begin = sent["started"] + FAULT_AT
    lasting = any(kind in fault for kind in ("silence", "freeze", "swap"))
    end = begin + (FAULT_FOR if lasting else 0.0)
    said = [(t, line.split(": ", 1)[-1]) for t, line in session.said if begin < t < sent["started"] + lab.seconds]
    first = said[0] if said else None
    back = next((t for t, line in said if line.endswith("receiving") or "again after" in line), None)
    table, wall = session.table, session.read_at
    camera, motors = table["camera"] != 0, table["camera"] == 0
    error = errors_of(lab, session, fault)
    spans = [(wall > begin - 3) & (wall < begin), (wall >= begin) & (wall < max(end, begin + 1)),
             (wall >= max(end, begin + 1)) & (wall < max(end, begin + 1) + 3)]
    largest = [" ".join(f"{e:5.2f}" for e in np.nanmax(error[span & motors], axis=0)) if (span & motors).any() else "none" for span in spans]
    kinds, numbers = np.unique(table.gate[camera & spans[1]], return_counts=True)
    gates = ", ".join(f"{kind} {number}" for kind, number in zip(kinds, numbers))
    again = np.flatnonzero(table.gate[camera & (wall >= end)] == "camera")
    counts = {k: sum(side[k] for side in session.report["live"]) for k in ("missing", "repeated", "dropped", "unpaired", "frozen")}
    words = first[1] if first else ", ".join(f"{v} {k}" for k, v in counts.items() if v)
    words += "".join(f", motor {m['motor']} {m['fault']}" for m in session.report.get("motor_failed", []))
    if "jitter" in fault:
        words += f", mean delay {1e3 * session.report['live'][0]['clock']['mean_delay']:.1f} ms" if of == "rows" else ""
    print(f"  {of + ' ' + fault:26s} {words[:48]:48s} {f'{first[0] - begin:.2f} s' if first else '':>6s} "
          f"{f'{back - end:.2f} s' if back else '':>6s}   {gates[:26]:26s} " + " | ".join(largest) +
          (f"   image {again[0] + 1}" if lasting and len(again) else ""), flush=True)


CASES = {"rows": rows_only, "tcp": over_tcp, "ros": over_ros, "window": in_the_window, "streams": over_ffmpeg,
         "file": from_file, "hd": in_hd, "faults": faults}
NEEDS = {"ros": ["rosmaster"], "window": ["rosmaster", "xvfb-run"], "streams": ["ffmpeg"], "hd": ["ffmpeg"]}
HD = 1.5  # pixels of 1280 × 720 for one of 640 × 480


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=60.0, help="length of the recording [s]")
    parser.add_argument("--only", nargs="+", choices=CASES, default=list(CASES))
    parser.add_argument("--cli", default=ROOT / "build/release/app/cli/capstan-cli")
    parser.add_argument("--window", default=ROOT / "build/release/tests/benchmarks/live_window")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="capstan_live_") as folder:
        labs = {}
        for name in arguments.only:
            seconds = FAULT_SESSION if name == "faults" else arguments.seconds
            scale = HD if name == "hd" else None
            print(f"{name}: {CASES[name].__doc__}, {seconds:g} s", flush=True)
            missing = [program for program in NEEDS.get(name, []) if not shutil.which(program)]
            if missing:
                print(f"  not run: {missing[0]} is not installed")
                continue
            key = seconds, scale
            if key not in labs:
                at = pathlib.Path(folder, f"{seconds:g}{'_hd' if scale else ''}")
                at.mkdir()
                labs[key] = Laboratory(str(arguments.cli), at, seconds, scale)
                labs[key].window = str(arguments.window)
            CASES[name](labs[key])


if __name__ == "__main__":
    sys.exit(main())
