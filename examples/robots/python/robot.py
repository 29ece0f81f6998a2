#!/usr/bin/env python3
"""A robot in the simulator's place, with python3 alone: the sorting table of world.py on the bus.

    PYTHONPATH=build/release/share/python ./robot.py [--bus URL] [--key FILE] [--speed FACTOR]

Put a camera and controllers in the place of World. ./prospect check-robot tells whether a robot keeps to the rules.
"""
import argparse
import os
import random
import signal
import sys
import time

import prospect
import world
from prospect import (action_command_t, action_status_t, action_t, cause_t, health_t, label_t, observation_t, sim_command_t,
                      task_t)

TICK, FASTEST, SILENT = 0.5, 0.002, 3.0  # seconds; FASTEST: what a recorder can follow


class Robot:
    def __init__(self, bus, speed):
        self.bus, self.tick_seconds = bus, max(TICK / speed, FASTEST) if speed > 0 else FASTEST
        self.id, self.taken, self.heard, self.next_tick = random.getrandbits(62), {}, 0.0, 0.0
        self.begin_episode(random.getrandbits(62) + 1, seed=0)
        bus.subscribe(action_command_t, self.on_action)
        bus.subscribe(sim_command_t, self.on_reset)
        bus.subscribe(health_t, self.on_health)

    def begin_episode(self, episode_id, seed, holder=0):
        self.world, self.status = world.World(seed), action_status_t()
        self.status.episode_id, self.status.holder_id, self.status.action = episode_id, holder, -1
        self.status.state, self.status.outcome = action_status_t.STATE_IDLE, label_t.OUTCOME_RUNNING

    def running(self):
        return self.status.state == action_status_t.STATE_RUNNING

    def run(self):
        half_seconds, due = 0, 0.0
        while True:
            now = time.monotonic()
            if self.running() and now >= self.next_tick:
                self.tick(now)
            self.watch_holder(now)
            if now >= due:  # at least at 2 Hz, and once a second
                due, half_seconds = now + 0.5, half_seconds + 1
                self.bus.publish(self.status)
                if half_seconds % 2:
                    self.say_health(), self.say_task(), self.look()
            self.bus.turn(max(0.0, (min(due, self.next_tick) if self.running() else due) - time.monotonic()))

    def is_new(self, channel, sender, command_id):
        """Each command is carried out once, however often it arrives: the ids of a sender grow."""
        latest = self.taken.get((channel, sender), -1)
        self.taken[channel, sender] = max(latest, command_id)
        return command_id > latest

    def held_by_another(self, sender):
        return self.status.holder_id not in (0, sender)

    def on_action(self, command):
        if not self.is_new("action", command.executive_id, command.command_id):
            return self.bus.publish(self.status)
        start, before = command.kind == action_command_t.KIND_START, self.status
        refusal = self.world.refusal(command.action) if start else ""
        if start and self.running():
            refusal = "another action is running"
        if command.episode_id != self.status.episode_id:
            refusal = f"meant for another episode: here is {self.status.episode_id}"
        if self.held_by_another(command.executive_id):
            refusal = f"busy, held by executive {self.status.holder_id}"
        apart = refusal and (self.running() or self.held_by_another(command.executive_id))
        if apart:  # told once, and nothing else changes
            self.status = action_status_t.decode(before.encode())
        self.status.executive_id, self.status.command_id, self.status.reason = command.executive_id, command.command_id, refusal
        if refusal:
            self.status.state = action_status_t.STATE_REFUSED
        elif start:
            self.start(command)
        elif self.running():
            self.stop()
        self.bus.publish(self.status)
        if apart:
            self.status = before

    def start(self, command):
        self.world.begin(command.action)
        self.status.action, self.status.holder_id = command.action, command.executive_id
        self.status.state = action_status_t.STATE_RUNNING
        self.heard = self.next_tick = time.monotonic()

    def stop(self):
        self.world.stop()
        self.status.state = action_status_t.STATE_CANCELLED

    def on_reset(self, command):
        """A new scene, as a simulator puts it up; a robot that cannot tidy its table begins an episode with what lies there."""
        if not self.is_new("reset", command.sender_id, command.command_id) or command.kind != sim_command_t.KIND_RESET:
            return
        if not self.held_by_another(command.sender_id) and command.present_episode_id == self.status.episode_id:
            self.begin_episode(command.episode_id, command.seed, command.sender_id)
            self.heard = time.monotonic()
            self.look()
        self.bus.publish(self.status)

    def on_health(self, health):
        if health.instance_id == self.status.holder_id:
            leaves = health.state == health_t.STATE_DRAINING
            self.heard = time.monotonic() - (SILENT + 1 if leaves else 0)

    def watch_holder(self, now):
        if self.status.holder_id and now - self.heard > SILENT:
            if self.running():
                self.stop()
            self.status.holder_id = 0
            self.bus.publish(self.status)

    def tick(self, now):
        self.next_tick = now + self.tick_seconds
        self.status.frame += 1
        self.status.sim_time_us = round(1e6 * TICK * self.status.frame)
        goes_on = self.world.tick()
        self.look()
        if not goes_on:
            self.finish()

    def finish(self):
        self.status.state, self.status.reason = action_status_t.STATE_SUCCEEDED, self.world.cause
        if self.world.cause:
            self.status.state, self.status.outcome = action_status_t.STATE_FAILED, label_t.OUTCOME_FAILURE
        elif self.world.put_away == world.ENOUGH:
            self.status.outcome = label_t.OUTCOME_SUCCESS
        self.bus.publish(self.status)

    def look(self):
        picture = observation_t()
        picture.episode_id, picture.frame, picture.sim_time_us = self.status.episode_id, self.status.frame, self.status.sim_time_us
        picture.encoding, picture.width, picture.height = observation_t.ENCODING_RGB8, world.SIDE, world.SIDE
        picture.data = self.world.picture()
        picture.num_bytes = len(picture.data)
        self.bus.publish(picture)

    def say_health(self):
        health = health_t()
        health.service, health.instance_id, health.pid = "simulator", self.id, os.getpid()  # whose place it takes
        health.state = health_t.STATE_BUSY if self.running() else health_t.STATE_READY
        self.bus.publish(health)

    def say_task(self):
        task = task_t()
        task.name, task.world_version, task.task_hash = "sorting", "1", 1  # change them with the table
        task.num_actions = len(world.ACTIONS)
        for index, (side, kind, thing) in enumerate(world.ACTIONS):
            row = action_t()
            row.index, row.name, row.kind = index, world.name(index), f"{side}_{kind}"
            row.object, row.successors = world.thing(index), world.SUCCESSORS[index]
            row.num_successors = len(row.successors)
            task.actions.append(row)
        task.initial, task.num_initial, task.plan_length = world.TAKES, len(world.TAKES), world.PLAN_LENGTH
        task.image_width = task.image_height = world.SIDE
        task.tick_seconds, task.action_time_limit = TICK, 2 * TICK * world.TICKS
        for name, words in world.CAUSES.items():
            cause = cause_t()
            cause.name, cause.words = name, words
            task.causes.append(cause)
        task.num_causes = len(task.causes)
        self.bus.publish(task)


def main():
    options = argparse.ArgumentParser(description="the sorting table in the simulator's place")
    options.add_argument("--bus", metavar="URL")
    options.add_argument("--key", metavar="FILE", help="the deployment's; without one the bus is open")
    options.add_argument("--speed", type=float, default=1, help="1: as a clock runs; 0: as fast as it can")
    given = options.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    try:
        Robot(prospect.Bus(given.bus, given.key), given.speed).run()
    except KeyboardInterrupt:
        pass
    except (OSError, ValueError) as error:
        sys.exit(f"error: {error}")


if __name__ == "__main__":
    main()
