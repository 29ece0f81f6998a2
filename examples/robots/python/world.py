"""The sorting table: two grippers, four coloured blocks, three bins; two of the blocks are to be put into bins.

What decides is in the picture alone. A gripper reaches three of the four places (the left one not the rightmost, and the
other way round), takes no block that another stands on, and puts one block into a bin that has no lid; the left one fills
the left and the middle bin, the right one the middle and the right. So a block taken by the wrong gripper has nowhere to go.
The same rules, scenes and pictures in C++ and Java: ../cpp/world.h, ../java/World.java.
"""
COLOURS = ("red", "green", "blue", "yellow")
BINS = ("left_bin", "middle_bin", "right_bin")
# (gripper, kind, object): the action table, in TASK's order.
ACTIONS = [(side, "take", block) for side in ("left", "right") for block in range(4)] + [
    ("left", "put", 0), ("left", "put", 1), ("right", "put", 1), ("right", "put", 2)]
TAKES, LEFT_PUTS, RIGHT_PUTS = list(range(8)), [8, 9], [10, 11]
SUCCESSORS = [LEFT_PUTS] * 4 + [RIGHT_PUTS] * 4 + [TAKES] * 4
ENOUGH, PLAN_LENGTH = 2, 4  # blocks in bins, each taken and put
CAUSES = {"reach": "it stands out of this gripper's reach", "blocked": "another block stands on it",
          "gone": "it was put away before", "lid": "the lid is on this bin", "full": "this bin is full"}

SIDE = 64  # pixels
TICKS = 10  # of an action; the gripper is there after half of them
PAINT = ((230, 40, 40), (40, 200, 60), (50, 90, 240), (240, 220, 40))
FLOOR, TABLE, ALARM, GRIPPER, LID, WALL = (30, 30, 30), (90, 90, 90), (255, 140, 0), (255, 255, 255), (235, 235, 235), (0, 190, 190)
HOME = {"left": (8, 34), "right": (40, 34)}


def thing(action):
    _, kind, number = ACTIONS[action]
    return COLOURS[number] if kind == "take" else BINS[number]


def name(action):
    side, kind, _ = ACTIONS[action]
    return f"{side}_{kind}({thing(action)})"


class Dice:
    """SplitMix64: the same numbers in every language."""

    def __init__(self, seed):
        self.state = seed

    def below(self, bound):
        mask = (1 << 64) - 1
        self.state = (self.state + 0x9E3779B97F4A7C15) & mask
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & mask
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
        return ((z ^ (z >> 31)) >> 33) % bound


class World:
    def __init__(self, seed):
        """A scene: four blocks on three of the places, one of them on another; no bin, one or two with a lid."""
        dice = Dice(seed)
        order = list(range(4))
        for i in range(3, 0, -1):
            j = dice.below(i + 1)
            order[i], order[j] = order[j], order[i]
        first, tall, lids, odd = dice.below(2), dice.below(3), dice.below(5), dice.below(3)
        self.places = [[], [], [], []]  # blocks of each place, from below
        for i in range(3):
            self.places[first + i].append(order[i])
        self.places[first + tall].append(order[3])
        # In one scene of five two bins are closed, and two blocks have no room; in two of five one is.
        self.lids = [lids == 0 and i != odd or lids in (1, 2) and i == odd for i in range(3)]
        self.bins = [None, None, None]
        self.hands = {"left": None, "right": None}
        self.action, self.tick_count, self.cause, self.put_away = None, 0, "", 0

    def refusal(self, action):
        """Why it cannot be begun at all; empty: it can."""
        if not 0 <= action < len(ACTIONS):
            return "there is no such action"
        side, kind, _ = ACTIONS[action]
        if self.cause or self.put_away == ENOUGH:
            return "the episode is over"
        if kind == "take" and any(block is not None for block in self.hands.values()):
            return "a gripper holds a block"
        if kind == "put" and self.hands[side] is None:
            return "this gripper holds no block"
        return ""

    def begin(self, action):
        self.action, self.tick_count, self.goal = action, 0, self._goal(action)

    def stop(self):
        self.action = None

    def tick(self):
        """One step of the action that was begun; False once it is over: see cause."""
        self.tick_count += 1
        if self.tick_count == TICKS // 2:
            self.cause = self._defect()
            if self.cause:
                return False  # the gripper stays where it failed
            self._move()
        if self.tick_count == TICKS:
            self.action = None
        return self.action is not None

    def _place_of(self, block):
        return next((i for i, place in enumerate(self.places) if block in place), None)

    def _defect(self):
        side, kind, thing = ACTIONS[self.action]
        if kind == "put":
            return "lid" if self.lids[thing] else "full" if self.bins[thing] is not None else ""
        place = self._place_of(thing)
        if place is None:
            return "gone"
        if place == (3 if side == "left" else 0):
            return "reach"
        return "" if self.places[place][-1] == thing else "blocked"

    def _move(self):
        side, kind, thing = ACTIONS[self.action]
        if kind == "take":
            self.hands[side] = thing
            self.places[self._place_of(thing)].pop()
        else:
            self.bins[thing], self.hands[side] = self.hands[side], None
            self.put_away += 1

    def _goal(self, action):
        """Corner of the gripper's picture where it acts, or as near as it comes."""
        side, kind, thing = ACTIONS[action]
        if kind == "put":
            return 4 + 20 * thing, 44
        place = self._place_of(thing)
        if place is None:
            return HOME[side]
        x = min(16 * place, 32) if side == "left" else max(16 * place, 16)
        return x, 14 * (1 - self.places[place].index(thing)) + 2

    def picture(self):
        """64x64 pixels, three bytes each."""
        pixels = bytearray(bytes(FLOOR) * (SIDE * SIDE))

        def fill(x, y, width, height, colour):
            for row in range(max(y, 0), min(y + height, SIDE)):
                left, right = max(x, 0), min(x + width, SIDE)
                pixels[3 * (row * SIDE + left):3 * (row * SIDE + right)] = bytes(colour) * (right - left)

        fill(0, 28, SIDE, 4, ALARM if self.cause else TABLE)
        for i, place in enumerate(self.places):
            for level, block in enumerate(place):
                fill(16 * i + 1, 14 * (1 - level), 14, 14, PAINT[block])
        for i in range(3):
            fill(4 + 20 * i, 48, 16, 16, WALL)
            inside = LID if self.lids[i] else FLOOR if self.bins[i] is None else PAINT[self.bins[i]]
            fill(6 + 20 * i, 48, 12, 14, inside)
        for side in ("left", "right"):
            x, y = HOME[side]
            if self.action is not None and ACTIONS[self.action][0] == side:
                goal_x, goal_y = self.goal
                way = self.tick_count if self.cause else min(self.tick_count, TICKS - self.tick_count)
                x += (goal_x - x) * way * 2 // TICKS
                y += (goal_y - y) * way * 2 // TICKS
            fill(x, y - 2, 16, 4, GRIPPER)
            if self.hands[side] is not None:
                fill(x + 1, y + 2, 14, 10, PAINT[self.hands[side]])
        return bytes(pixels)
