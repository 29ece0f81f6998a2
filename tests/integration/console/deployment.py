"""A deployment with the scripted engine and a console, on the bus of the test (with_bus.sh), and what is asked of both."""
import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time

BIN = os.path.abspath(os.environ["PROSPECT_TEST_BIN"])
SECONDS = 60


def program(name):
    return os.path.join(BIN, name)


def until(condition, what, seconds=SECONDS):
    """Waits until a condition gives something, which is returned."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        found = condition()
        if found:
            return found
        time.sleep(0.1)
    raise AssertionError(f"not within {seconds} s: {what}")


class Console:
    """prospect-console as it is started by hand."""

    def __init__(self, folder, *arguments, port="0"):
        self.folder = folder
        self.arguments = arguments
        self.start(port)

    def start(self, port="0"):
        self.log = open(os.path.join(self.folder, "console.log"), "ab")
        self.process = subprocess.Popen([program("prospect-console"), "--port", port, "--no-browser", *self.arguments],
                                        stdout=subprocess.PIPE, stderr=self.log, cwd=self.folder, text=True)
        line = self.process.stdout.readline()
        found = re.match(r"The console: (http://[^/]+/\S*)", line)
        assert found, f"the console did not start: {line}{self.errors()}"
        self.url = found[1]
        self.host = re.match(r"http://([^/]+)/", self.url)[1]
        self.port = int(self.host.rsplit(":", 1)[1])

    def errors(self):
        with open(os.path.join(self.folder, "console.log"), encoding="utf-8", errors="replace") as file:
            return file.read()[-2000:]

    def stop(self, number=signal.SIGTERM):
        if self.process.poll() is None:
            self.process.send_signal(number)
        self.process.wait(20)
        self.process.stdout.close()
        self.log.close()

    def memory_mb(self):
        with open(f"/proc/{self.process.pid}/status", encoding="utf-8") as file:
            return int(re.search(r"VmRSS:\s+(\d+)", file.read())[1]) / 1024

    def cpu_seconds(self):
        with open(f"/proc/{self.process.pid}/stat", encoding="utf-8") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@contextlib.contextmanager
def deployment(*arguments, task="navigation", weights="scripted", workers=2):
    """`prospect up` on this bus; gives the folder in which everything of it lies."""
    folder = tempfile.mkdtemp(prefix="console-")
    os.environ["XDG_RUNTIME_DIR"] = folder
    os.chmod(folder, 0o700)
    try:
        subprocess.run([program("prospect"), "up", "--task", task, "--weights", weights, "--workers", str(workers), "--quiet",
                        *arguments], check=True, cwd=folder, stderr=subprocess.DEVNULL)
        yield folder
    finally:
        subprocess.run([program("prospect"), "down", "--quiet"], check=False, cwd=folder, stderr=subprocess.DEVNULL)
        shutil.rmtree(folder, ignore_errors=True)


def key_file(folder):
    said = subprocess.run([program("prospect"), "key"], check=True, capture_output=True, text=True, cwd=folder)
    return said.stdout.strip()


def console_arguments(folder):
    """What `prospect console` hands on to a console that joins the deployment."""
    key = key_file(folder)
    return ["--key", key, "--services-file", os.path.join(os.path.dirname(key), "services.json")]


def result_of(folder, seed, task="navigation"):
    with open(os.path.join(folder, "out", f"{task}-{seed}", "result.json"), encoding="utf-8") as file:
        return json.load(file)
