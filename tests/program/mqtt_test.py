# SPDX-License-Identifier: Apache-2.0
# Estimates on a real MQTT broker: what subscribers get, and what becomes of a run without its broker.
import json
import os
import signal
import subprocess
import time
import unittest

from broker import Broker, Subscription
from program import PROGRAM, RIGS, ProgramTest, read_rows

LIVE = [PROGRAM, "run", "sim:", "--rig", RIGS / "paper.toml"]


class BrokerTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.broker = self.new_broker()
        self.broker.start()

    def new_broker(self, *settings):
        broker = Broker(self.folder, *settings)
        self.addCleanup(broker.close)
        return broker

    def subscribe(self, topics="#", *options):
        subscription = Subscription(self.broker, topics, *options)
        self.addCleanup(subscription.close)
        return subscription

    def address(self, topic, who=""):
        return f"mqtt://{who}127.0.0.1:{self.broker.port}/{topic}"

    def start(self, topic, *arguments, who="", **options):
        process = subprocess.Popen([*LIVE, "-o", self.address(topic, who), *map(str, arguments)],
                                   stderr=subprocess.PIPE, text=True, **options)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def finish(self, process, stop=signal.SIGINT):
        """Stops a run; what it said."""
        process.send_signal(stop)
        self.assertEqual(process.wait(timeout=60), 0)
        return process.stderr.read()

    def run_for(self, seconds, topic, *arguments, **options):
        """Runs to its end; what it said."""
        process = self.start(topic, "--seconds", seconds, *arguments, **options)
        self.assertEqual(process.wait(timeout=60), 0)
        return process.stderr.read()


class MqttTest(BrokerTest):
    def test_a_run_is_published_from_its_description_to_its_end(self):
        for qos in (0, 1, 2):
            with self.subTest(qos=qos):
                topic = f"lab/rig{qos}"
                process = self.start(topic, "--mqtt-qos", qos, "-o", "-", "--format", "jsonl",
                                     stdout=subprocess.PIPE)
                process.stdout.readline()
                heard = self.subscribe(topic + "/#")
                heard.wait_for(lambda heard: len(heard.seqs(topic)) > 10, "estimates come")
                said = self.finish(process)
                lines = process.stdout.read().splitlines()
                process.stdout.close()
                self.assertNotIn("dropped", said)
                self.assertNotIn("warning", said)
                heard.wait_for(lambda heard: heard.payloads(topic + "/state")[-1:] == ["offline"],
                               "the end is told")
                rows = {json.loads(line)["seq"]: json.loads(line) for line in lines}
                seqs = heard.seqs(topic)
                self.assertEqual(seqs, list(range(seqs[0], max(rows) + 1)))
                for payload in heard.payloads(topic + "/estimate")[1:]:
                    message = json.loads(payload)
                    self.assertLess(abs(message.pop("timestamp") - time.time()), 60)
                    self.assertEqual(message, rows.get(message["seq"], message))

    def test_who_subscribes_later_gets_the_rig_and_that_it_is_online(self):
        process = self.start("rig", stdout=subprocess.DEVNULL)
        self.subscribe().wait_for(lambda heard: heard.seqs("rig"), "estimates come")
        late = self.subscribe()
        late.wait_for(lambda heard: len(heard.messages()) > 2, "retained messages come")
        retained = {topic: payload for topic, kept, payload in late.messages() if kept}
        self.assertEqual(set(retained), {"rig/rig", "rig/state"})
        self.assertEqual(retained["rig/state"], "online")
        rig = json.loads(retained["rig/rig"])
        self.assertEqual(rig["penduline"], "0.1.0")
        self.assertEqual(rig["estimator"], "gn")
        self.assertEqual(rig["pendulum"]["length_m"], 0.3)
        self.assertEqual([sensor["name"] for sensor in rig["sensors"]], ["Sx", "Sy"])
        self.finish(process)

    def test_the_last_will_tells_of_a_rig_that_was_killed(self):
        process = self.start("rig", stdout=subprocess.DEVNULL)
        heard = self.subscribe()
        heard.wait_for(lambda heard: heard.seqs("rig"), "estimates come")
        self.assertEqual(heard.payloads("rig/state"), ["online"])
        process.kill()
        heard.wait_for(lambda heard: heard.payloads("rig/state") == ["online", "offline"],
                       "the last will comes")
        late = self.subscribe("rig/state")
        late.wait_for(lambda heard: heard.messages() == [("rig/state", True, "offline")],
                      "the last will is retained")

    def test_two_rigs_meet_on_one_broker(self):
        runs = [self.start("lab/one", stdout=subprocess.DEVNULL),
                self.start("lab/two", "--case", "conical", stdout=subprocess.DEVNULL)]
        heard = self.subscribe("lab/#")
        for topic in ("lab/one", "lab/two"):
            heard.wait_for(lambda heard, topic=topic: len(heard.seqs(topic)) > 20, "estimates come")
        self.finish(runs[0])
        heard.wait_for(lambda heard: heard.payloads("lab/one/state")[-1] == "offline", "one ends")
        self.assertEqual(heard.payloads("lab/two/state")[-1], "online")
        before = len(heard.seqs("lab/two"))
        heard.wait_for(lambda heard: len(heard.seqs("lab/two")) > before + 5, "the other goes on")
        self.finish(runs[1])
        for topic in ("lab/one", "lab/two"):
            seqs = heard.seqs(topic)
            self.assertEqual(seqs, list(range(seqs[0], seqs[0] + len(seqs))))

    def test_a_broker_that_restarts_is_said_once_and_costs_no_row_of_level_1(self):
        process = self.start("rig", "--mqtt-qos", 1, stdout=subprocess.DEVNULL)
        heard = self.subscribe("#", "--disable-clean-session", "--id", "durable")
        heard.wait_for(lambda heard: len(heard.seqs("rig")) > 5, "estimates come")
        self.broker.stop()
        time.sleep(1.5)  # the first attempt to connect again fails
        last = heard.seqs("rig")[-1]
        self.broker.start()
        heard.wait_for(lambda heard: heard.seqs("rig")[-1] > last + 60, "estimates come again")
        said = self.finish(process)
        self.assertEqual(said.count("no broker; it is tried again"), 1)
        self.assertEqual(said.count("the broker is there again"), 1)
        self.assertNotIn("dropped", said)
        # The rows of the pause were kept; the level allows to hear one twice.
        seqs = sorted(set(heard.seqs("rig")))
        self.assertEqual(seqs, list(range(seqs[0], seqs[-1] + 1)))
        heard.wait_for(lambda heard: heard.payloads("rig/state")[-2:] == ["online", "offline"],
                       "the state is told again")

    def test_a_broker_that_comes_late_gets_the_rows_that_waited(self):
        self.broker.stop()
        process = self.start("rig", stdout=subprocess.DEVNULL)
        time.sleep(0.5)
        self.broker.start()
        heard = self.subscribe()
        heard.wait_for(lambda heard: len(heard.seqs("rig")) > 30, "estimates come")
        said = self.finish(process)
        self.assertIn("no broker; it is tried again, and the newest 4096 estimates wait: "
                      "Connection refused\n", said)
        self.assertNotIn("dropped", said)
        self.assertEqual(heard.seqs("rig")[0], 0)

    def test_without_a_broker_the_run_goes_on_and_counts(self):
        self.broker.stop()
        said = self.run_for(1, "rig", "-o", self.folder / "a.csv")
        self.assertEqual(len((self.folder / "a.csv").read_text().splitlines()), 21)
        self.assertIn(f"; dropped: 20 rows by {self.address('rig')}\n", said)
        self.assertEqual(said.count("warning"), 1)

    def test_a_broker_that_stalls_holds_no_sample_up(self):
        recording = self.folder / "rec.csv"
        process = self.start("rig", "--mqtt-qos", 1, "--rate", 5000, "--seconds", 2, "--record",
                             recording)
        heard = self.subscribe()
        heard.wait_for(lambda heard: heard.seqs("rig"), "estimates come")
        os.kill(self.broker.process.pid, signal.SIGSTOP)
        self.addCleanup(os.kill, self.broker.process.pid, signal.SIGCONT)
        self.assertEqual(process.wait(timeout=60), 0)
        said = process.stderr.read()
        self.assertIn("10000 samples at 5000.000 Hz, 0 lost", said)
        self.assertEqual(len(read_rows(recording)), 10000)
        self.assertRegex(said, r"dropped: \d+ rows by mqtt://")
        os.kill(self.broker.process.pid, signal.SIGCONT)
        heard.wait_for(lambda heard: heard.payloads("rig/state")[-1:] == ["offline"],
                       "the last will is told when the broker goes on")

    def test_a_new_program_on_a_topic_takes_it_over(self):
        first = self.start("rig", stdout=subprocess.DEVNULL)
        heard = self.subscribe()
        heard.wait_for(lambda heard: heard.seqs("rig"), "estimates come")
        os.kill(first.pid, signal.SIGSTOP)  # as if its machine were gone without a word
        second = self.start("rig", stdout=subprocess.DEVNULL)
        heard.wait_for(lambda heard: heard.payloads("rig/state") == ["online", "offline", "online"],
                       "the broker ends the first one and takes the second")
        self.finish(second)
        os.kill(first.pid, signal.SIGCONT)


class PasswordTest(BrokerTest):
    def setUp(self):
        ProgramTest.setUp(self)
        passwords = self.folder / "passwords"
        passwords.touch(mode=0o600)
        subprocess.run(["mosquitto_passwd", "-b", passwords, "ann", "se:cr@t"], check=True)
        self.broker = self.new_broker(f"password_file {passwords}")
        self.broker.start()

    def heard_from(self, said):
        self.assertNotIn("warning", said)
        self.assertNotIn("dropped", said)

    def test_the_password_may_stand_in_a_file(self):
        path = self.write("password", "se:cr@t\n")
        self.heard_from(self.run_for(0.5, "rig", "--mqtt-password-file", path, who="ann@"))

    def test_the_password_may_stand_in_the_environment(self):
        self.heard_from(self.run_for(0.5, "rig", who="ann@", env={
            **os.environ, "PENDULINE_MQTT_PASSWORD": "se:cr@t"}))

    def test_the_password_may_stand_in_the_address_and_is_not_shown(self):
        self.heard_from(self.run_for(0.5, "rig", who="ann:se%3Acr%40t@"))
        said = self.run_for(0.5, "rig", who="ann:wrong@")
        self.assertIn("not authorised", said)
        self.assertNotIn("wrong", said)

    def test_a_password_file_that_is_not_there_is_said(self):
        process = self.start("rig", "--mqtt-password-file", "nowhere", who="ann@")
        self.assertEqual(process.wait(timeout=60), 1)
        self.assertEqual(process.stderr.read(), "error: nowhere: found no line, expected the "
                         "password of the MQTT broker\n")


class TlsTest(BrokerTest):
    def setUp(self):
        ProgramTest.setUp(self)
        self.certificate = self.folder / "cert.pem"
        key = self.folder / "key.pem"
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
                        "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2", "-subj",
                        "/CN=localhost", "-addext", "subjectAltName=IP:127.0.0.1", "-keyout", key,
                        "-out", self.certificate], check=True, capture_output=True)
        self.broker = self.new_broker(f"certfile {self.certificate}", f"keyfile {key}")
        self.broker.start()

    def address(self, topic, who=""):
        return "mqtts" + super().address(topic, who).removeprefix("mqtt")

    def test_by_tls_where_the_certificate_is_trusted(self):
        said = self.run_for(1, "rig", env={**os.environ, "SSL_CERT_FILE": str(self.certificate)})
        self.assertNotIn("warning", said)
        self.assertNotIn("dropped", said)

    def test_a_certificate_that_is_not_trusted_is_no_broker(self):
        said = self.run_for(1, "rig")
        self.assertEqual(said.count("no broker; it is tried again"), 1)
        self.assertIn("20 rows by mqtts://127.0.0.1", said)


if __name__ == "__main__":
    unittest.main()
