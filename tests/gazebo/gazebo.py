# SPDX-License-Identifier: Apache-2.0
"""Common parts of the tests in the real Gazebo: worlds, gzserver, roscore, rosbag and their results.

Based on the harness of tests/command and the processes of scripts/gazebo-experiment.
"""

import contextlib
import importlib.machinery
import importlib.util
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(TOP / "tests/command"))
from common import (  # noqa: E402,F401  pylint: disable=wrong-import-position,unused-import
    Skip, case, check, check_between, check_equal, check_in, check_near, main, read_csv, read_json,
    run)

_LOADER = importlib.machinery.SourceFileLoader("experiment", str(TOP / "scripts/gazebo-experiment"))
experiment = importlib.util.module_from_spec(
    importlib.util.spec_from_loader(_LOADER.name, _LOADER))
_LOADER.exec_module(experiment)

IN_GAZEBO = TOP / "scripts/in-gazebo"
RATE_HZ = 15.0
EACH_UPDATE = ("/rfid/reads", "/rfid/truth/antennas")
RECORDED = (*EACH_UPDATE, "/rfid/truth/tags", "/rfid/truth/tags_moved")


def require_gazebo(context):
    """Skips the case if Gazebo 11, the plugins or ROS are missing."""
    done = subprocess.run([str(IN_GAZEBO), "true"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        raise Skip(done.stdout.strip() or "there is no Gazebo 11")
    if not (context.plugins / "libgazeboRfidAntennaPlugin.so").exists():
        raise Skip(f"the plugins are not built ({context.plugins})")
    for program in ("roscore", "rosbag"):
        if shutil.which(program) is None:
            raise Skip(f"{program} is missing (scripts/setup --gazebo installs it)")


# --- Worlds ---------------------------------------------------------------------------------------

def world(*parts, factor=1.0, step_s=0.001):
    """A world with this step size that runs at a multiple of real time; 0 for the maximum speed."""
    return (f'<?xml version="1.0"?><sdf version="1.6"><world name="default">'
            f'<physics type="ode"><max_step_size>{step_s}</max_step_size>'
            f'<real_time_update_rate>{factor / step_s}</real_time_update_rate></physics>'
            f'<gravity>0 0 0</gravity>{"".join(parts)}</world></sdf>')


def model(name, pose, sensors, static=True):
    """A model of one link with sensors, such as a single tag."""
    return (f'<model name="{name}"><static>{int(static)}</static><pose>{pose}</pose>'
            f'<link name="link">{sensors}</link></model>')


def antenna_sensor(name="antenna", parameters="", rate=RATE_HZ, pose="0 0 0 0 0 0"):
    return (f'<sensor name="{name}" type="rfid"><update_rate>{rate}</update_rate>'
            f'<pose>{pose}</pose><plugin name="{name}" filename="libgazeboRfidAntennaPlugin.so">'
            f'{parameters}</plugin></sensor>')


def tag_sensor(name="tag", parameters="", pose="0 0 0 0 0 0"):
    return (f'<sensor name="{name}" type="rfidtag"><pose>{pose}</pose>'
            f'<plugin name="{name}" filename="libgazeboRfidTagPlugin.so">{parameters}</plugin>'
            f'</sensor>')


def tag(name, x, y, z, parameters="", static=True):
    return model(name, f"{x} {y} {z} 0 0 0", tag_sensor(parameters=parameters), static)


def antenna(name, x, y, z, parameters="<range>1000</range>", static=True):
    return model(name, f"{x} {y} {z} 0 0 0", antenna_sensor(name, parameters), static)


def schedule(log, events="", stop=None):
    """The test's plugin: events at simulated times, and a log of models that come and go."""
    last = f'<stop time="{stop}"/>' if stop else ""
    return (f'<plugin name="schedule" filename="libtagfield_test_schedule.so"><log>{log}</log>'
            f'{events}{last}</plugin>')


def escaped(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def insert(time_s, text):
    """An event of the schedule: a model is inserted."""
    return f'<insert time="{time_s}">{escaped(f"<sdf version={chr(39)}1.6{chr(39)}>{text}</sdf>")}</insert>'


def remove(time_s, name):
    return f'<remove time="{time_s}">{name}</remove>'


# --- Runs -----------------------------------------------------------------------------------------

class Recorder(experiment.Recorder):
    """A recorder that loses no message and reports those received so far."""

    def command(self):
        return [TOP / "tests/gazebo/recorder.py", self.bag, *self.topics]

    def stamps(self):
        """(topic, stamp [ns]) of each message received so far."""
        lines = self.process.log.read_text(encoding="utf-8", errors="replace").split("\n")[:-1]
        pairs = [line.split() for line in lines if line.startswith("/")]
        return [(topic, int(stamp)) for topic, stamp in pairs]

    def has_reached(self, stamp):
        """Whether the topics of each update have reached a stamp [ns]."""
        reached = {topic for topic, at in self.stamps() if at >= stamp}
        return reached.issuperset(EACH_UPDATE)

    def settle(self):
        """Waits until no message has arrived for a while."""
        count = -1
        while count != len(self.stamps()):
            count = len(self.stamps())
            time.sleep(1.0)


class Run:
    """A gzserver with a world, and by default a ROS master."""

    def __init__(self, context, text, *, name="world", record=False, master=True, env=None,
                 command=("gzserver",)):
        require_gazebo(context)
        self.context = context
        self.folder = context.folder / name
        self.folder.mkdir(exist_ok=True)
        self.world = self.folder / "world.sdf"
        self.world.write_text(text, encoding="utf-8")
        self.stack = contextlib.ExitStack()
        self.master_port = experiment.free_port()
        home = self.folder / "home"
        home.mkdir()
        self.env = {**os.environ, "HOME": str(home), "ROS_HOME": str(home),
                    "ROS_LOG_DIR": str(home), "ROS_IP": "127.0.0.1",
                    "ROS_MASTER_URI": f"http://127.0.0.1:{self.master_port}", **(env or {})}
        self.env.pop("ROS_HOSTNAME", None)
        experiment.gazebo_environment(self.env, str(context.source / "models"), context.plugins)
        self.bag = self.folder / "run.bag"
        self.recorder = None
        self.with_record = record
        self.with_master = master
        self.command = command
        self.server = None
        self.core = None

    def __enter__(self):
        try:
            if self.with_master:
                self.start_master()
            # Before Gazebo; otherwise the recorder would wait for simulated time to begin.
            if self.with_record:
                self.recorder = Recorder(self.bag, RECORDED, RECORDED, self.folder, self.env)
                self.stack.callback(self.recorder.process.stop)
            options = ["--verbose"] + (["-u"] if self.with_record else [])
            self.server = experiment.Process("gzserver", [IN_GAZEBO, *self.command, *options,
                                                          self.world],
                                             self.folder / "gzserver.log", self.env)
            self.stack.callback(self.server.stop)
            if self.with_record:
                experiment.wait_for("connecting the recorder", self.recorder.is_connected,
                                    [self.recorder.process, self.server])
                experiment.unpause(lambda: self.recorder.has_reached(0), self.server, self.env)
        except BaseException:
            self.stack.close()
            raise
        return self

    def __exit__(self, *_):
        self.stack.close()
        if self.context.show:
            print(self.log())

    def start_master(self):
        self.core = experiment.Process("roscore", ["roscore", "-p", self.master_port],
                                       self.folder / "roscore.log", self.env)
        self.stack.callback(self.core.stop)
        experiment.wait_for("starting roscore",
                            lambda: experiment.master_answers(self.env["ROS_MASTER_URI"]),
                            [self.core])

    def start(self, name, *command):
        """Starts another program, such as a subscriber; it ends with the run."""
        process = experiment.Process(name, command, self.folder / f"{name}.log", self.env)
        self.stack.callback(process.stop)
        return process

    def log(self):
        return (self.folder / "gzserver.log").read_text(encoding="utf-8", errors="replace")

    def wait_for(self, what, ready, seconds=120.0):
        experiment.wait_for(what, ready, [self.server], seconds)

    def published(self):
        """Topics with publishers, according to the master."""
        proxy = experiment.xmlrpc.client.ServerProxy(self.env["ROS_MASTER_URI"])
        return {name for name, _ in proxy.getSystemState("/test")[2][0]}

    def gz(self, *words):
        return subprocess.run([str(IN_GAZEBO), "gz", *words], env=self.env, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout

    def is_alive(self):
        return self.server.process.poll() is None

    def finish(self, log, seconds=120.0):
        """Waits for the schedule's end and the last update before it, and closes the bag."""
        self.wait_for("the schedule", lambda: "stopped" in read_if_there(log), seconds)
        last = int(read_if_there(log).split()[-2]) - int(1.5e9 / RATE_HZ)
        self.wait_for("the last update", lambda: self.recorder.has_reached(last))
        self.recorder.settle()
        self.recorder.finish()
        check_equal(self.recorder.lost(), {}, "messages lost by the recorder")


def read_if_there(path):
    return pathlib.Path(path).read_text(encoding="utf-8") if pathlib.Path(path).exists() else ""


def messages(bag, topic):
    """The messages of a topic in the bag, in order of their stamps."""
    import rosbag  # pylint: disable=import-outside-toplevel
    found = [message for _, message, _ in rosbag.Bag(str(bag)).read_messages(topics=[topic])]
    return sorted(found, key=lambda message: message.header.stamp)


def recorded_in(bag):
    """Wall time [s] from the receipt of the first message to that of the last."""
    import rosbag  # pylint: disable=import-outside-toplevel
    with rosbag.Bag(str(bag)) as opened:
        return opened.get_end_time() - opened.get_start_time()


def nanoseconds(stamp):
    return stamp.secs * 1_000_000_000 + stamp.nsecs


def lines_of_json(path):
    """The complete lines of a file that another program is still writing."""
    text = pathlib.Path(path).read_text(encoding="utf-8", errors="replace")
    return [json.loads(line) for line in text.split("\n")[:-1] if line.startswith("{")]
