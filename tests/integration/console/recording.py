"""A recording that was never heard on any bus: its names are markup."""
import struct

import prospect

EVIL = '<img src=x onerror="window.harmed=1"><script>window.harmed=1</script>"\'&'
EPISODE = 5


def action(index):
    row = prospect.action_t()
    row.index, row.name, row.kind, row.object = index, f"{EVIL}{index}", EVIL, EVIL
    row.successors = [0, 1]
    row.num_successors = 2
    return row


def task():
    said = prospect.task_t()
    said.name, said.world_version, said.task_hash = EVIL, EVIL, 1
    said.actions = [action(0), action(1)]
    said.num_actions = 2
    said.initial, said.num_initial, said.plan_length = [0, 1], 2, 2
    said.image_width = said.image_height = 8
    said.tick_seconds, said.action_time_limit = 0.1, 10
    cause = prospect.cause_t()
    cause.name = cause.words = EVIL
    said.causes, said.num_causes = [cause], 1
    return said


def observation(frame):
    seen = prospect.observation_t()
    seen.episode_id, seen.frame, seen.encoding = EPISODE, frame, 1
    seen.width = seen.height = 8
    seen.num_bytes, seen.data = 192, bytes([20 * frame] * 192)
    return seen


def status(state, reason=""):
    said = prospect.action_status_t()
    said.episode_id, said.executive_id, said.holder_id, said.command_id = EPISODE, 3, 3, 1
    said.frame, said.state, said.reason = 1, state, reason
    return said


def health():
    said = prospect.health_t()
    said.service, said.host, said.message = EVIL, EVIL, EVIL
    said.instance_id, said.state = 9, 2
    return said


def plan():
    said = prospect.plan_t()
    said.executive_id, said.search_id, said.episode_id, said.decision, said.reason = 3, 7, EPISODE, 2, EVIL
    step = prospect.plan_step_t()
    step.name = EVIL
    said.steps, said.num_steps = [step], 1
    return said


def write(path):
    """The whole of it, a tenth of a second between messages."""
    messages = [("TASK", task()), ("HEALTH", health()), ("OBSERVATION", observation(0)), ("PLAN", plan()),
                ("ACTION_STATUS", status(2)), ("OBSERVATION", observation(1)), ("ACTION_STATUS", status(4, EVIL)),
                (EVIL, health())]
    with open(path, "wb") as file:
        for number, (channel, message) in enumerate(messages):
            name, data = channel.encode(), message.encode()
            file.write(struct.pack(">IqqII", 0xEDA1DA01, number, 10**15 + 100000 * number, len(name), len(data)) + name + data)
