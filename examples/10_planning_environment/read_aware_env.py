#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A Gymnasium environment for read-aware planning: drive so that every tag is read often.

    PYTHONPATH=build/release/lib/python python3 examples/10_planning_environment/read_aware_env.py

An action is a forward velocity and a turn rate, held for one second. An observation is the robot's
believed pose and how often it has read each tag. The reward counts each read that a tag still needs,
minus a cost for time and for hitting walls. If Gymnasium is installed, the class derives from its Env;
it also works without Gymnasium.
"""

import math

import numpy as np

import tagfield

try:
    from gymnasium import Env
    from gymnasium.spaces import Box
except ImportError:
    Env = Box = None

HALF_WIDTH_M, HALF_LENGTH_M = 1.9, 5.8  # Free floor between the racks.


class ReadAwareEnv(Env or object):
    """Environment of the warehouse scenario with the robot p3at.

    observation: float32 (3 + tags,): x, y [m], yaw [rad], then each tag's share of the wanted reads.
    action: (forward velocity [m/s] in 0 … 0.5, turn rate [rad/s] in -1 … 1).

    An episode is truncated after `limit_s`, and terminates when every tag was read `wanted` times.
    """

    def __init__(self, wanted=40, limit_s=90.0):
        self.wanted, self.limit_s = wanted, limit_s
        self.scenario = tagfield.load(tagfield.share("scenarios/paper_warehouse.yaml")).with_(
            {"duration_s": limit_s, "antennas.mobile.range_m": 4})
        self.tags = list(self.scenario.tags)
        if Box:
            self.action_space = Box(np.float32([0.0, -1.0]), np.float32([0.5, 1.0]))
            self.observation_space = Box(-np.inf, np.inf, (3 + len(self.tags),), np.float32)

    def reset(self, *, seed=None, options=None):
        self.sim = self.scenario.simulation(seed=seed, robot="p3at")
        self.start = self.sim.robot_pose()
        self.counts = np.zeros(len(self.tags), dtype=int)
        return self._observation(), {}

    def step(self, action):
        forward, turn = np.clip(action, [0.0, -1.0], [0.5, 1.0])
        x, y, _ = self.sim.robot_pose()
        self.sim.drive(float(forward), float(turn))
        reads = self.sim.run_until(self.sim.now_s + 1.0)
        before = np.minimum(self.counts, self.wanted).sum()
        names = reads.names("tag")
        self.counts += np.array([(names == tag).sum() for tag in self.tags])
        gained = np.minimum(self.counts, self.wanted).sum() - before
        hits_wall = abs(x) > HALF_WIDTH_M or abs(y) > HALF_LENGTH_M
        reward = gained / self.wanted - 0.02 - 1.0 * hits_wall
        terminated = bool((self.counts >= self.wanted).all())
        return self._observation(), float(reward), terminated, self.sim.finished, {"counts": self.counts}

    def _observation(self):
        c, s = math.cos(self.start[2]), math.sin(self.start[2])
        x, y, yaw = self.sim.odometry  # Relative to the start pose, which is known.
        place = [self.start[0] + c * x - s * y, self.start[1] + s * x + c * y, self.start[2] + yaw]
        return np.array([*place, *np.minimum(self.counts / self.wanted, 1.0)], dtype=np.float32)


class GreedyPolicy:
    """Drives along the aisles to the tag that lacks the most reads, with a preference for near tags."""

    def __init__(self, env):
        self.places = np.array(list(env.scenario.tags.values()))

    def __call__(self, observation):
        x, y, yaw = observation[:3]
        lacking = 1.0 - observation[3:]
        away = np.hypot(self.places[:, 0] - x, self.places[:, 1] - y)
        goal = self.places[np.argmax(np.where(lacking > 0, lacking - 0.05 * away, -np.inf))]
        # Next to the tag in its aisle; to the other aisle around the ends of the pallets in the middle.
        aisle = math.copysign(1.4, goal[0])
        target = (aisle, goal[1]) if x * aisle > 0 else (aisle, math.copysign(5.2, y))
        if x * aisle < 0 and abs(y) < 5.0:
            target = (math.copysign(1.4, x), math.copysign(5.4, y))
        bearing = math.atan2(target[1] - y, target[0] - x) - yaw
        bearing = math.atan2(math.sin(bearing), math.cos(bearing))
        close = math.hypot(target[0] - x, target[1] - y) < 0.4
        return (0.0 if abs(bearing) > 0.6 or close else 0.45), bearing


def at_random(seed):
    """A policy of random actions, as a baseline."""
    draw = np.random.default_rng(seed)
    return lambda observation: (draw.uniform(0.0, 0.5), draw.uniform(-1.0, 1.0))


def episode(env, policy, seed):
    observation, _ = env.reset(seed=seed)
    total, done = 0.0, False
    while not done:
        observation, reward, terminated, truncated, _ = env.step(policy(observation))
        total, done = total + reward, terminated or truncated
    return total, env.sim.now_s, env.counts


def main():
    env = ReadAwareEnv()
    for name, policy in (("greedy", GreedyPolicy(env)), ("random", at_random(1))):
        total, seconds, counts = episode(env, policy, seed=1)
        enough = int((counts >= env.wanted).sum())
        print(f"{name}: {enough} of {len(counts)} tags read {env.wanted} times in {seconds:.0f} s, return {total:.2f}")


if __name__ == "__main__":
    main()
