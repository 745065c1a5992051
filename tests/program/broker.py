# SPDX-License-Identifier: Apache-2.0
# A real MQTT broker for the tests, and what it has been told.
import json
import os
import shutil
import socket
import subprocess
import time

PATH = os.environ["PATH"] + ":/usr/sbin"  # where Debian puts the broker


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Broker:
    """mosquitto on a port of its own; keeps retained messages over a restart."""

    def __init__(self, folder, *settings):
        self.port = free_port()
        self.settings = folder / "mosquitto.conf"
        self.log = open(folder / "mosquitto.log", "a", encoding="utf-8")
        allowed = [] if any("password_file" in line for line in settings) else [
            "allow_anonymous true"]
        user = ["user root"] if os.geteuid() == 0 else []  # else it may not write to the folder
        self.settings.write_text("\n".join([
            f"listener {self.port} 127.0.0.1", *allowed, *user, *settings, "persistence true",
            f"persistence_location {folder}/", ""]), encoding="utf-8")
        self.process = None

    def start(self):
        program = shutil.which("mosquitto", path=PATH)
        if program is None:
            raise FileNotFoundError("found no program mosquitto, expected the Debian package's")
        self.process = subprocess.Popen([program, "-c", self.settings], stdout=self.log,
                                        stderr=self.log)
        deadline = time.monotonic() + 30
        while True:
            try:
                socket.create_connection(("127.0.0.1", self.port), 1).close()
                return
            except OSError:
                if time.monotonic() > deadline or self.process.poll() is not None:
                    raise
                time.sleep(0.02)

    def stop(self):
        if self.process:
            self.process.terminate()
            self.process.wait(timeout=30)
            self.process = None

    def close(self):
        self.stop()
        self.log.close()


class Subscription:
    """What comes on the topics; `mosquitto_sub` hears it."""

    def __init__(self, broker, topics="#", *options):
        self.process = subprocess.Popen(
            ["mosquitto_sub", "-h", "127.0.0.1", "-p", str(broker.port), "-t", topics, "-q", "2",
             "-F", "%r %t %p", *options], stdout=subprocess.PIPE, text=True)
        os.set_blocking(self.process.stdout.fileno(), False)
        self.text = ""

    def messages(self):
        """Topic, whether it was retained, and payload of all that has come."""
        try:
            self.text += os.read(self.process.stdout.fileno(), 1 << 20).decode()
        except BlockingIOError:
            pass
        whole = self.text[:self.text.rfind("\n") + 1]
        return [(topic, retained == "1", payload) for retained, topic, payload in
                (line.split(" ", 2) for line in whole.splitlines())]

    def payloads(self, topic):
        return [payload for its, _, payload in self.messages() if its == topic]

    def seqs(self, topic):
        return [json.loads(payload)["seq"] for payload in self.payloads(topic + "/estimate")]

    def wait_for(self, condition, what):
        deadline = time.monotonic() + 60
        while not condition(self):
            if time.monotonic() > deadline:
                raise AssertionError(f"{what}: {self.text[-1000:]}")
            time.sleep(0.02)

    def close(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()
