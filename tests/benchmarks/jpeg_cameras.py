"""Two network cameras whose JPEG images are made beforehand, and the rows of their robot: what a laboratory's cameras and
robot send, at the cost of sending it."""
import http.server
import multiprocessing
import os
import pathlib
import socket
import threading
import time

BOUNDARY = b"frame"
EYES = ("left", "right")


class Recording:
    """`folder` has the images left_00001.jpg … and right_00001.jpg …; times are those of the recording [s]."""

    def __init__(self, folder, exposures, arrivals, row_times, rows, header):
        self.folder, self.exposures, self.arrivals = pathlib.Path(folder), exposures, arrivals
        self.row_times, self.rows, self.header = row_times, rows, header


def serve(recording, image_port, row_port, ready, go, sent):
    """Sends all images and rows in real time, from `go` on, and counts the images in `sent`. Runs in a process of its own."""
    jpegs = {eye: [path.read_bytes() for path in sorted(recording.folder.glob(f"{eye}_*.jpg"))] for eye in EYES}
    begun = threading.Event()
    first = recording.row_times[0]
    begin = 0.0

    def wait_until(t):
        time.sleep(max(0.0, begin + t - first - time.time()))

    class Camera(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            self.send_response(200)
            self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=" + BOUNDARY.decode())
            self.end_headers()
            begun.wait()
            eye = self.path.strip("/")
            try:
                for jpeg, exposure, arrival in zip(jpegs[eye], recording.exposures, recording.arrivals, strict=True):
                    wait_until(arrival)
                    self.wfile.write(b"--" + BOUNDARY + b"\r\nContent-Type: image/jpeg\r\nContent-Length: %d\r\nX-Timestamp: %.6f\r\n\r\n"
                                     % (len(jpeg), begin + exposure - first) + jpeg + b"\r\n")
                    sent[EYES.index(eye)] += 1
            except OSError:
                pass  # the session has ended: what it did not take is not counted

        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", image_port), Camera)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    ready.set()
    go.wait()
    robot = socket.create_connection(("127.0.0.1", row_port))
    begin = time.time() + 0.1
    begun.set()
    robot.sendall(recording.header)
    for k, t in enumerate(recording.row_times):
        if k % 5 == 0:
            wait_until(t)
        robot.sendall(recording.rows[k])
    time.sleep(0.3)


class Senders:
    """The process that serves. It waits for go()."""

    def __init__(self, recording, image_port, row_port):
        ready, self.begin = multiprocessing.Event(), multiprocessing.Event()
        self.sent = multiprocessing.Array("l", len(EYES))  # images by eye
        self.process = multiprocessing.Process(target=serve, args=(recording, image_port, row_port, ready, self.begin, self.sent))
        self.process.start()
        ready.wait(60)

    def go(self):
        """Sends everything; returns what the process used."""
        self.begin.set()
        return os.wait4(self.process.pid, 0)[2]
