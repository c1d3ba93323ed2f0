#!/usr/bin/python3
"""Makes the corpora of the fuzz targets in tests/fuzz/corpus again, but for crash-* files, which fuzzing found.

    tests/fuzz/make_corpus.py build/release/app/cli/capstan-cli

Needs python3-h5py, python3-scipy and python3-rosbag.
"""
import pathlib
import sqlite3
import struct
import subprocess
import sys
import tempfile
import zlib

import genpy
import h5py
import numpy as np
import rosbag
import scipy.io

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORPUS = pathlib.Path(__file__).resolve().parent / "corpus"
CLI = pathlib.Path(sys.argv[1]).resolve()
WORK = pathlib.Path(tempfile.mkdtemp())


def cli(*words):
    subprocess.run([CLI, *map(str, words)], check=True, cwd=WORK, stdout=subprocess.DEVNULL)


def put(target, name, content):
    folder = CORPUS / target
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())


def resource(name):
    return (ROOT / "resources" / name).read_text()


LAUGHS = "a: &a [1, 1, 1, 1, 1, 1, 1, 1, 1]\n" + "".join(
    f"{chr(98 + i)}: &{chr(98 + i)} [" + ", ".join([f"*{chr(97 + i)}"] * 9) + "]\n" for i in range(8))
DEEP = "joints: " + "[" * 400 + "]" * 400 + "\n"
HOSTILE_YAML = {
    "exponential-aliases": LAUGHS,
    "nested": DEEP,
    "self": "joints: &a [*a, *a]\n",
    "numbers": "gravity: [1e400, .nan, -.inf]\nname: \"\\0\"\n",
    "twice": "name: a\nname: b\n",
    "end-of-file-character": "name: a\n\x04gravity: [0, 0, 0]\n",
    "second-document": "name: a\n---\nname: b\n",
    "key-is-list": "? [a, b]\n: 1\n",
}


def yaml_corpora():
    for target, files in {
        "robot_file": ["robots/raven2_left.yaml"],
        "truth_file": ["truth/default.yaml", "truth/debridement.yaml"],
        "experiment_file": ["experiments/A.yaml", "experiments/pulleys_known.yaml"],
        "live_setup": ["live/ros.yaml", "live/rows_and_cameras.yaml", "live/rows_over_tcp.yaml"],
        "option_files": ["tracking/default.yaml", "identification/default.yaml"],
        "registration_history": [],
    }.items():
        for file in files:
            put(target, file.replace("/", "-"), resource(file))
        for name, text in HOSTILE_YAML.items():
            put(target, name + ".yaml", text)
    put("option_files", "registration.yaml",
        "translation: [0.1, 0.2, 0.3]\nrotation:\n  - [1, 0, 0]\n  - [0, 0, -1]\n  - [0, 1, 0]\n")
    put("option_files", "trajectory.yaml", "kind: sinusoid\nduration: 2\n")
    put("marker_file", "plain.yaml", "hue: [50, 70]\n")
    put("marker_file", "unknown.yaml", "colour: green\n")
    entry = "  - {date: 2026-01-02T03:04:05, decision: %s, method: %s, robot: one%s}\n"
    pose = ", rms: 0.001, used: 5, translation: [0.1, 0.2, 0.3], rotation: [[1, 0, 0], [0, 0, -1], [0, 1, 0]]"
    put("registration_history", "three.yaml", "registrations:\n" + entry % ("accepted", "hard stop", pose)
        + entry % ("rejected", "several poses", ", reason: blurred") + entry % ("imported", "file", pose))
    put("registration_history", "half.yaml",
        "registrations:\n" + entry % ("accepted", "file", ", translation: [0.1, 0.2, 0.3]"))
    put("experiment_file", "recordings.yaml",
        "name: bench\nwork: track\nrobot: [A, B]\ntrials:\n  - {name: one, recording: ../one.capstan, read_as: q_m=deg}\n"
        "  - {name: two, seed: 9007199254740992, occlusion: {percentage: 40}}\n")


def camera_corpora():
    left, right = resource("cameras/left.yaml"), resource("cameras/right.yaml")
    put("camera_info", "rig", left + "\n====\n" + right)
    put("camera_info", "exchanged", right + "\n====\n" + left)
    put("camera_info", "never-calibrated", left.replace("data", "data: [0] #") + "\n====\n" + right)
    camera = ("  camera_model: pinhole\n  distortion_coeffs: [-0.1, 0.05, 0.001, 0]\n  distortion_model: radtan\n"
              "  intrinsics: [500.0, 501.0, 320.5, 240.5]\n  resolution: [640, 480]\n")
    chain = ("cam0:\n" + camera + "cam1:\n  T_cn_cnm1:\n  - [1.0, 0.0, 0.0, -0.06]\n  - [0.0, 1.0, 0.0, 0.0]\n"
             "  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n" + camera)
    put("kalibr", "camchain.yaml", chain)
    put("kalibr", "huge-numbers.yaml", chain.replace("[1.0, 0.0, 0.0, -0.06]", "[1e200, 1e200, -1e200, -0.06]"))
    put("kalibr", "huge-size.yaml", chain.replace("[640, 480]", "[1e300, 480]"))
    put("kalibr", "exponential-aliases.yaml", LAUGHS)
    numbers = {"M1": (3, 3, "500, 0, 320, 0, 500, 240, 0, 0, 1"), "D1": (1, 5, "-0.1, 0.05, 0.001, 0, 0"),
               "R": (3, 3, "1, 0, 0, 0, 1, 0, 0, 0, 1"), "T": (3, 1, "-0.06, 0, 0")}
    numbers["M2"], numbers["D2"] = numbers["M1"], numbers["D1"]
    yml = "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\n" + "".join(
        f"{k}: !!opencv-matrix\n   rows: {r}\n   cols: {c}\n   dt: d\n   data: [ {d} ]\n" for k, (r, c, d) in numbers.items())
    put("opencv_rig", "rig.yml", yml)
    put("opencv_rig", "huge.yml", yml.replace("rows: 3\n   cols: 3", "rows: 100000\n   cols: 100000", 1))
    put("opencv_rig", "infinite.yml", yml.replace("-0.06", "-.Inf"))
    put("opencv_rig", "nested.yml", "%YAML:1.0\n---\nM1: " + "[" * 2000 + "]" * 2000 + "\n")
    put("opencv_rig", "nested.json", '{"M1":' + "[" * 2000 + "]" * 2000 + "}")
    put("opencv_rig", "nested.xml", '<?xml version="1.0"?><opencv_storage>' + "<a>" * 2000)
    put("opencv_rig", "rig.xml", '<?xml version="1.0"?>\n<opencv_storage>\n<image_width>640</image_width>\n'
        "<image_height>480</image_height>\n" + "".join(
            f'<{k} type_id="opencv-matrix">\n<rows>{r}</rows>\n<cols>{c}</cols>\n<dt>d</dt>\n<data>\n{d.replace(",", "")}</data></{k}>\n'
            for k, (r, c, d) in numbers.items()) + "</opencv_storage>\n")
    put("opencv_rig", "rig.json", '{"image_width": 640, "image_height": 480, ' + ", ".join(
        f'"{k}": {{"type_id": "opencv-matrix", "rows": {r}, "cols": {c}, "dt": "d", "data": [ {d} ]}}'
        for k, (r, c, d) in numbers.items()) + "}")


TABLE = "t,q_m1,q_m2,q_m3,dq_m1,dq_m2,dq_m3,q1,q2,q3,p_c1,p_c2,p_c3,note\n" + "".join(
    f"{i / 1000},{80 + i / 7:.6f},{60 + i / 9:.6f},{300 + i / 3:.6f},1,2,3,0.5,1.6,0.4,,0.1,-0.2,0\n" for i in range(4))


def table_corpora():
    put("measured_table", "table.csv", TABLE)
    put("measured_table", "marked.csv", "\ufeff" + "t;q\n1;2\n")
    put("measured_table", "numbers.csv", "t,q_m1,q_m2,q_m3\n1e400,1,2,3\n")
    put("measured_table", "not-finite.csv", "t,q_m1,q_m2,q_m3\n0,nan,inf,3\n")
    put("measured_table", "back.csv", "t,q_m1\n2,1\n1,1\n")
    put("measured_table", "nul.csv", "t,q_m1\n2,\0\n")
    put("measured_table", "beyond.csv", "t,q_m1\n1e300,1\n1e301,2\n")
    put("measured_table", "empty-lines.csv", "t,q_m1,q_m2,q_m3\n1,2,3,4\n" + "\n" * 400 + "5,6,7,8\n")
    put("motor_log", "log.csv", "t_s,mpos1_deg,mpos2_deg,mpos3_deg,mvel1_degps,mvel2_degps,mvel3_degps,jpos1_deg,jpos2_deg,"
        "jpos3_m_times_57.2958,tau1,tau2,tau3\n" + "".join(f"{i / 100},10,20,30,1,2,3,4,5,6,.1,.2,.3\n" for i in range(3)))
    put("motor_log", "time-twice.csv", "t_s,mpos1_deg,mpos2_deg,mpos3_deg,mvel1_degps,mvel2_degps,mvel3_degps,jpos1_deg,"
        "jpos2_deg,jpos3_m_times_57.2958,tau1,tau2,tau3,t_s\n0,1,2,3,1,2,3,4,5,6,.1,.2,.3,0.5\n1,1,2,3,1,2,3,4,5,6,.1,.2,.3,1.5\n")
    put("motor_log", "table.csv", TABLE)
    poses = ("task,traj,t_cam_s,cam_x,cam_y,cam_z,cam_qx,cam_qy,cam_qz,cam_qw,t_cmd_s,cmd_x,cmd_y,cmd_z,cmd_qx,cmd_qy,cmd_qz,"
             "cmd_qw\n")
    put("pose_table", "poses.csv", poses + "".join(
        f"1,{i // 2},{i / 10},0.1,0.2,0.{i},0,0,0,1,{i / 10},0.1,0.2,0.3,0,0,0.6,0.8\n" for i in range(4)))
    put("pose_table", "column-twice.csv", "traj," + poses.replace("task,", "").replace("traj", "traj") +
        "1,2,0,1,1,1,0,0,0,1,0,1,1,1,0,0,0,1\n")
    put("pose_table", "not-unit.csv", poses + "1,1,0,0,0,0,0,0,0,0,0,1e308,1e308,1e308,1e308,1e308,1e308,1e308\n")
    put("json_lines", "table.jsonl", "".join(f'{{"t": {i / 1000}, "q_m1": {i}, "q_m2": null, "text": [1, {{"a": 2}}]}}\n' for i in range(3)))
    put("json_lines", "late-key.jsonl", '{"t": 1}\n{"t": 2, "q_m1": 3}\n{"q_m1": 3, "t": 4}\n')
    put("json_lines", "numbers.jsonl", '{"t": 1e400}\n')
    put("json_lines", "nested.jsonl", '{"t": 1, "a": ' + "[" * 3000 + "]" * 3000 + "}\n")
    put("json_lines", "many-keys.jsonl", "{" + ", ".join(f'"k{i}": 1' for i in range(200)) + ', "t": 0}\n' + "{}\n" * 200)
    put("pair_table", "points.csv", "x,y,z,cam_x,cam_y,cam_z\n" + "".join(
        f"{x},{y},{z},{y},{-x},{z}\n" for x, y, z in [(0, 0, 0), (.1, 0, 0), (0, .1, 0), (0, 0, .1), (.1, .1, 0)]))
    put("pair_table", "pixels", "left_u,left_v,right_u,right_v,left_sigma,right_sigma\n320,240,300,240,1,1\n300,200,280,200,1,1\n"
        "\n====\nx,y,z\n0,0,0.1\n0.1,,0.2\n")
    put("pair_table", "huge.csv", "x,y,z,cam_x,cam_y,cam_z\n" + "1e308,1e308,-1e308,1e-308,1e308,1\n" * 5)
    rows = TABLE.split("\n", 1)
    put("row_stream", "ordered", "\x01" + TABLE)
    put("row_stream", "real-time", "\x08" + TABLE + rows[1] + "1e9,1,2,3,1,2,3,1,2,3,,,,0\n" + rows[1])
    put("row_stream", "long-line", "\x10" + "t,q_m1,q_m2,q_m3\n" + "1" * 300)


def network():
    head = "--b\r\nContent-Type: image/jpeg\r\n"
    put("multipart", "lengths", "\x05\r\n" + (head + "Content-Length: 4\r\nX-Timestamp: 12.25\r\n\r\nJPEG\r\n") * 3 + "--b--\r\n")
    put("multipart", "boundaries", "\x00" + (head + "\r\nJ\nPE--bG\r\n") * 2 + head + "\r\n--b\n")
    put("multipart", "wrong-length", "\x02" + head + "Content-Length: 2\r\n\r\nJPEG\r\n" + head + "Content-Length: 99999999999\r\n\r\n")
    put("multipart", "page", "\x20<html>" + "no camera " * 500)
    put("http_url", "password", "us%65r:p%2fw@camera.local:8080/stream.mjpg?size=640")
    put("http_url", "ipv6", "[::1]:81?a@b")
    put("http_url", "port", "host:65536/")


def binary_tables():
    t, q = np.arange(5) / 1000, np.linspace(0, 1, 5)
    columns = dict(t=t, q_m1=q, q_m2=q, q_m3=q.astype("f4"), note=np.arange(5, dtype="i1"))
    for name, options in {"plain.mat": {}, "compressed.mat": dict(do_compression=True)}.items():
        scipy.io.savemat(WORK / name, columns, **options)
        put("matlab", name, (WORK / name).read_bytes())
    scipy.io.savemat(WORK / "structure.mat", {"trial": columns}, do_compression=True)
    put("matlab", "structure.mat", (WORK / "structure.mat").read_bytes())
    scipy.io.savemat(WORK / "bomb.mat", dict(t=np.zeros(2_500_000, dtype="i1")), do_compression=True)
    put("matlab", "bomb.mat", (WORK / "bomb.mat").read_bytes())
    header = (WORK / "plain.mat").read_bytes()[:128]
    put("matlab", "no-elements.mat", header + b"\0" * 800)
    put("matlab", "huge-dimensions.mat", header + struct.pack("<IIIIIIIIii", 14, 64, 6, 8, 6, 0, 5, 8, 1 << 30, 1) +
        struct.pack("<HHcxxx", 1, 1, b"t") + struct.pack("<II", 9, 8) + b"\0" * 8)

    def h5(name, **options):
        with h5py.File(WORK / name, "w", libver=options.pop("libver", "earliest")) as file:
            for key, value in columns.items():
                file.create_dataset(key, data=value, **options)
        put("hdf5", name, (WORK / name).read_bytes())

    h5("contiguous.h5")
    h5("latest.h5", libver="latest", chunks=(2,), compression="gzip", shuffle=True)
    with h5py.File(WORK / "group.h5", "w") as file:
        file["trial/t"], file["trial/q_m1"] = t, q
        file["t"] = h5py.ExternalLink("/etc/passwd", "/t")
    put("hdf5", "group.h5", (WORK / "group.h5").read_bytes())
    with h5py.File(WORK / "fill.h5", "w") as file:
        for key in ("t", "q_m1", "q_m2", "q_m3"):
            file.create_dataset(key, shape=(1 << 20,), dtype="f8", chunks=(1 << 20,), fillvalue=1.0)
    put("hdf5", "fill.h5", (WORK / "fill.h5").read_bytes())


def row_crc(*row):
    """The check sum of core/recording/row_check.h."""
    crc = 0
    for value in row:
        kind, data = (("n", b"") if value is None else ("i", struct.pack("<q", value)) if isinstance(value, int) else
                      ("r", struct.pack("<d", value)) if isinstance(value, float) else
                      ("t", value.encode()) if isinstance(value, str) else ("b", bytes(value)))
        crc = zlib.crc32(data, zlib.crc32(struct.pack("<Q", len(data)), zlib.crc32(kind.encode(), crc)))
    return crc


def add_small_frame(session, full_size):
    """A pair of images of 8 x 4 pixels, in the codec of a session with images."""
    codec = list(sqlite3.connect(full_size).execute("SELECT id, name, width, height, fourcc, extradata FROM codec").fetchone())
    codec[2:4] = 8, 4
    packet = subprocess.run(["ffmpeg", "-loglevel", "error", "-f", "lavfi", "-i", "testsrc=size=8x4:rate=1", "-frames:v", "1", "-c:v",
                             "utvideo", "-pred", "left", "-pix_fmt", "gbrp", "-f", "rawvideo", "-"], check=True, capture_output=True).stdout
    data = sqlite3.connect(session)
    data.create_function("row_crc", -1, row_crc)
    data.execute("INSERT INTO codec VALUES (?1, ?2, ?3, ?4, ?5, ?6, row_crc('codec', ?1, ?2, ?3, ?4, ?5, ?6))", codec)
    data.execute("INSERT INTO frame VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, row_crc('frame', ?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8))",
                 (100, 0.05, 0.06, codec[0], 8, 4, packet, packet))
    data.commit()
    data.close()


def compact(session, version=2, after=""):
    """The session with pages of 512 bytes; version 1 has no check sums."""
    data = sqlite3.connect(session)
    tables = [row[0] for row in data.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
    if version == 1:
        for table in tables:
            data.execute(f"ALTER TABLE {table} DROP COLUMN crc")
        data.execute("PRAGMA user_version = 1")
    data.executescript(after)
    data.execute("PRAGMA journal_mode = DELETE")
    data.commit()
    data.isolation_level = None
    data.execute("PRAGMA page_size = 512")
    data.execute("VACUUM")
    data.close()
    return pathlib.Path(session).read_bytes()


def session_corpora():
    def recorded(name, *options):
        cli("simulate", "--out", name, "--duration", "0.1", "--seed", 7, "--trajectory", "hold", *options)
        data = sqlite3.connect(WORK / name)
        last = "SELECT max(seq) FROM (SELECT seq FROM motor ORDER BY seq LIMIT 12)"
        for table in ("motor", "joint"):
            data.execute(f"DELETE FROM {table} WHERE seq > ({last})")
        data.execute("DELETE FROM frame WHERE seq > (SELECT min(seq) FROM frame)")
        data.execute("DELETE FROM header WHERE key IN ('rows', 'truth', 'tracking')")
        data.execute("DELETE FROM dictionary")
        data.commit()
        data.close()
        return WORK / name

    tips = compact(recorded("tips.capstan", "--no-images"))
    full_size, images = recorded("full-size.capstan"), recorded("images.capstan", "--no-images")
    add_small_frame(images, full_size)
    images = compact(images)
    old = compact(recorded("old.capstan", "--no-images"), 1,
                  "INSERT INTO motor (seq, t) VALUES (9223372036854775807, 1.0), (-9223372036854775808, 2.0);"
                  "INSERT INTO frame (seq, t, codec, width, height) VALUES (77, 1.0, 5, 2000000000, 2000000000);")
    functions = compact(recorded("functions.capstan", "--no-images"), 2,
                        "CREATE VIEW v AS SELECT 1; DROP TABLE event;"
                        "CREATE VIEW event AS SELECT row_crc() AS seq, 0 AS t, '' AS kind, '' AS text, 0 AS crc;")
    for name, data in {"tips": tips, "images": images, "version-1": old, "functions": functions}.items():
        put("session", name + ".sqlite", data)
    put("recover", "version-1.sqlite", old)
    put("recover", "no-header.sqlite", b"\0" * 100 + tips[100:])
    put("sqlite_pages", "tips.sqlite", tips[: 512 * 8])
    page = bytearray(512)  # a leaf whose 250 cells are one, with overflow pages
    page[0], page[3:5] = 0x0D, struct.pack(">H", 200)
    page[8:408] = struct.pack(">H", 412) * 200
    page[412:420] = b"\x90\x00\x01\x03\x00\x00\x00\x00"
    put("sqlite_pages", "shared-cells.sqlite", tips[:512] + bytes(page) * 4)


def bag_corpora():
    class Kind:
        def __init__(self, kind, text="", md5="0" * 32):
            self._type, self._md5sum, self._full_text = kind, md5, text

    def header(stamp, frame=b""):
        return struct.pack("<III", 0, int(stamp), int(stamp % 1 * 1e9)) + struct.pack("<I", len(frame)) + frame

    def joints(stamp, values):
        return header(stamp) + struct.pack("<I", 0) + struct.pack("<I", len(values)) + struct.pack(f"<{len(values)}d", *values) + \
            struct.pack("<II", 0, 0)

    raven = (CORPUS / "raven_state" / "state").read_bytes().split(b"\n====\n")
    for compression in ("none", "bz2", "lz4"):
        with rosbag.Bag(WORK / "one.bag", "w", compression=compression) as bag:
            for i in range(3):
                stamp, kind = 100.0 + i / 10, Kind("sensor_msgs/JointState", "Header header")
                bag.write("/PSM1/actuators/measured_js", (kind._type, joints(stamp, (1.0, 2.0, 3.0)), kind._md5sum, kind), raw=True,
                          t=genpy.Time.from_sec(stamp))
        put("bag", f"joints-{compression}.bag", (WORK / "one.bag").read_bytes())
    with rosbag.Bag(WORK / "one.bag", "w") as bag:
        kind = Kind("raven_2/raven_state", raven[0].decode())
        for i in range(2):
            bag.write("/ravenstate", (kind._type, raven[1], kind._md5sum, kind), raw=True, t=genpy.Time.from_sec(100.0 + i))
    put("bag", "raven.bag", (WORK / "one.bag").read_bytes())
    with rosbag.Bag(WORK / "one.bag", "w") as bag:
        def write(topic, kind, stamp, data):
            bag.write(topic, (kind, header(stamp) + data, "0" * 32, Kind(kind, "Header header")), raw=True, t=genpy.Time.from_sec(stamp))

        def camera(baseline):
            k, r = (50.0, 0, 2, 0, 50.0, 2, 0, 0, 1), (1.0, 0, 0, 0, 1, 0, 0, 0, 1)
            p = (50.0, 0, 2, baseline, 0, 50, 2, 0, 0, 0, 1, 0)
            return struct.pack("<III9sI5d30d", 4, 4, 9, b"plumb_bob", 5, *(0.0,) * 5, *k, *r, *p)

        image = struct.pack("<III5sBII16s", 4, 4, 5, b"mono8", 0, 4, 16, bytes(range(16)))
        for side, baseline in (("left", 0.0), ("right", -3.0)):
            write(f"/{side}/camera_info", "sensor_msgs/CameraInfo", 100.0, camera(baseline))
            write(f"/{side}/image_raw", "sensor_msgs/Image", 100.05, image)
        write("/motors", "sensor_msgs/JointState", 100.0, joints(100.0, (1.0, 2.0, 3.0))[16:])
    put("bag", "images.bag", (WORK / "one.bag").read_bytes())


def message_corpora():
    definition = (ROOT / "core/ros1/raven_state.cpp").read_text().split('R"(')[1].split(')"')[0]
    body = struct.pack("<III", 1, 100, 5) + struct.pack("<I", 0) + b"\x01" * 1400
    put("raven_state", "state", definition.encode() + b"\n====\n" + body)
    put("raven_state", "negative-length", definition.replace("int32[6] pos\n", "int32[-40] pos\n").encode() + b"\n====\n" + body)
    put("raven_state", "huge-length", definition.replace("int32[6] pos\n", "int64[2305843009213693951] pos\n").encode() + b"\n====\n" + body)

    def text(value):
        return struct.pack("<I", len(value)) + value

    def image(height, width, encoding, step, data):
        return struct.pack("<III", 0, 1, 2) + text(b"left") + struct.pack("<II", height, width) + text(encoding) + b"\0" + \
            struct.pack("<I", step) + text(data)

    put("image_message", "bgr8", image(2, 3, b"bgr8", 9, b"\x10" * 18))
    put("image_message", "bayer", image(2, 2, b"bayer_rggb8", 2, b"\x10" * 4))
    put("image_message", "huge", image(65536, 65536, b"mono8", 65536, b""))
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    def png(width, height, raw):
        return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) + \
            chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b"")
    def compressed(data, kind=b"png"):
        return struct.pack("<III", 0, 1, 2) + text(b"left") + text(kind) + text(data)
    put("image_message", "png", compressed(png(3, 2, b"\0abc\0def")))
    put("image_message", "png-bomb", compressed(png(30000, 30000, b"\0" * 1000)))


def correction_corpora():
    rng = np.random.default_rng(1)
    rows = ["traj,t_cam_s,cam_x,cam_y,cam_z,cam_qx,cam_qy,cam_qz,cam_qw,t_cmd_s,cmd_x,cmd_y,cmd_z,cmd_qx,cmd_qy,cmd_qz,cmd_qw"]
    for i in range(120):
        x, y, z = 0.05 * np.sin(i / 7), 0.05 * np.cos(i / 5), 0.02 * np.sin(i / 11)
        rows.append(f"{i // 30},{i / 30:.4f},{x + rng.normal(0, 1e-4):.6f},{y:.6f},{z:.6f},0,0,0,1,"
                    f"{i / 30:.4f},{x + 0.01:.6f},{y:.6f},{z + 0.002 * np.sin(60 * x):.6f},0,0,0,1")
    (WORK / "poses.csv").write_text("\n".join(rows) + "\n")
    for method in ("offset", "none"):
        cli("learn", "--train", "poses.csv", "--method", method, "--inducing", 20, "--members", 1, "--no-cleaning", "--no-alignment",
            "--model", f"{method}.correction")
        put("correction_model", method + ".correction", (WORK / f"{method}.correction").read_bytes())
    first, second, numbers = (WORK / "none.correction").read_bytes().split(b"\n", 2)
    put("correction_model", "huge-inducing.correction",
        b"\n".join([first, second.replace(b'"inducing":20', b'"inducing":1000000000'), numbers[:4000]]))
    put("correction_model", "negative-inducing.correction",
        b"\n".join([first, second.replace(b'"inducing":20', b'"inducing":-9223372036854775808'), numbers[:4000]]))
    put("correction_model", "nan.correction", b"\n".join([first, second, struct.pack("<d", float("nan")) + numbers[8:]]))
    put("correction_model", "nested.correction",
        first + b"\n" + b'{"checksum": "0", "numbers": 0, "x": ' + b"[" * 5000 + b"]" * 5000 + b"}\n")


def experiment_corpora():
    (WORK / "small.yaml").write_text("name: small\nwork: track\nimages: false\ntrials:\n  - {name: a, trajectory: hold, duration: 0.1}\n")
    cli("experiment", "small.yaml", "--out", "whole")
    cli("experiment", "small.yaml", "--out", "part", "--shard", "1/2")
    whole, between = WORK / "whole" / "small", "\n====\n"
    put("experiment_results", "small", between.join([(whole / "results.json").read_text(), (whole / "series.json").read_text(),
        (WORK / "part" / "shard.json").read_text()]))
    put("experiment_results", "trial", 3 * between + (whole / "trials" / "a.json").read_text())
    put("experiment_results", "nested", "\n====\n".join(["[" * 3000, "{}", '{"format": 1e999}', '{"fingerprint": null}']))
    for k, value in enumerate(["q_m=deg,p_c=mm,t=ms", "motors=/a/b,left=/c", "2/8", "0.02deg,0.02mm", "silence:2@10", "step:-0.5@1e3",
                               "swap:2@10", "tcp://127.0.0.1:5555", "http://localhost:0", "igtl://127.0.0.1:18944", "ros:/topic"]):
        put("option_values", f"value-{k}", value)


yaml_corpora()
camera_corpora()
table_corpora()
network()
binary_tables()
message_corpora()
session_corpora()
bag_corpora()
correction_corpora()
experiment_corpora()
print(sum(f.stat().st_size for f in CORPUS.rglob("*") if f.is_file()), "bytes in", CORPUS)
