#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A ROS master that is missing, starts, dies and restarts: Gazebo continues, publishing resumes."""

import re

from gazebo import Run, antenna, case, check, check_in, experiment, lines_of_json, main, tag, world

WORLD = world(antenna("gate", 0, 0, 2), tag("one", 1, 0, 1))
TOPIC = "/gazebo/gate/data"


def messages_reach(running, context, name):
    """Starts a new subscriber, waits for its messages, and returns them."""
    listener = running.start(name, context.build / "bin/tag_array_subscriber", TOPIC)
    running.wait_for(f"messages for {name}", lambda: len(lines_of_json(listener.log)) > 20)
    return lines_of_json(listener.log)


def seconds(message):
    return message["stamp"][0] + 1e-9 * message["stamp"][1]


def simulated_s(running):
    """Gazebo's simulation time [s], without ROS."""
    text = running.gz("topic", "-e", "/gazebo/default/world_stats", "-d", "1")
    found = re.findall(r"sim_time \{\s*sec: (\d+)", text)
    return int(found[-1]) if found else -1


@case
def gazebo_goes_on_without_a_master_and_publishes_when_one_comes(context):
    with Run(context, WORLD, master=False) as running:
        running.wait_for("simulation", lambda: simulated_s(running) >= 2)
        running.start_master()
        heard = messages_reach(running, context, "first")
        check(all(message["ntags"] == 1 for message in heard), "the tag is not read")
        topics = running.published()
        check({"/clock", "/rfid/reads", "/rfid/truth/tags"} <= topics, f"topics are {topics}")
        proxy = experiment.xmlrpc.client.ServerProxy(running.env["ROS_MASTER_URI"])
        check(proxy.getParam("/test", "/use_sim_time")[2] is True, "/use_sim_time is not set")


@case
def gazebo_outlives_its_master_and_finds_the_next(context):
    with Run(context, WORLD) as running:
        first = messages_reach(running, context, "first")
        running.core.stop()
        before = simulated_s(running)
        running.wait_for("simulation without a master",
                         lambda: simulated_s(running) >= before + 3)
        listened = len(lines_of_json(running.folder / "first.log"))
        running.start_master()
        again = messages_reach(running, context, "second")
        check(seconds(again[0]) > seconds(first[-1]), "time went back")
        proxy = experiment.xmlrpc.client.ServerProxy(running.env["ROS_MASTER_URI"])
        check(proxy.getParam("/test", "/use_sim_time")[2] is True, "/use_sim_time is not set")
        check(len(lines_of_json(running.folder / "first.log")) > listened,
              "who listened before hears no more")


@case
def an_address_that_is_none_is_one_error(context):
    with Run(context, WORLD, master=False, env={"ROS_MASTER_URI": "nonsense"}) as running:
        running.wait_for("simulation", lambda: simulated_s(running) >= 2)
        check_in("ROS_MASTER_URI is 'nonsense', expected http://HOST:PORT", running.log(), "log")


if __name__ == "__main__":
    main()
