"""Prospect's messages and a client, for python3 alone.

    import prospect
    with prospect.connect() as robot:
        robot.look().save("now.png")
        plan = robot.plan()
        for step in plan:
            print(step.name, step.score)
            step.picture.save(step.name + ".png")
            if not robot.carry_out(step.action):
                break

README.md of clients/python says more. lcm-gen adds the message types here when Prospect is built.
"""
from .bus import Bus
from .client import Lost, Robot, connect
from .picture import Picture

