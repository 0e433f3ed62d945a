"""Computes the table `expected.csv` from the formulas of docs/light.md, independently of the Rust code.

Run: python3 crates/light/tests/expected.py > crates/light/tests/expected.csv
"""

import math

WORD = (1 << 64) - 1
MOMENTS = 10


def clamp(x):
    return min(max(x, 0.0), 1.0)


def frac(x):
    return x - math.floor(x)


def mix64(z):
    z = (z + 0x9E3779B97F4A7C15) & WORD
    z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & WORD
    z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & WORD
    return z ^ (z >> 31)


def h(*words):
    state = 0
    for word in words:
        state = mix64(state ^ (word & WORD))
    return (state >> 11) / 2.0**53


def decode(code):
    return code / 12.92 if code <= 0.04045 else ((code + 0.055) / 1.055) ** 2.4


EASES = {
    "linear": lambda u: u,
    "smooth": lambda u: u * u * (3 - 2 * u),
    "sine": lambda u: (1 - math.cos(math.pi * u)) / 2,
    "in": lambda u: u * u,
    "out": lambda u: 1 - (1 - u) ** 2,
}
WRAPS = {
    "once": clamp,
    "loop": frac,
    "mirror": lambda phase: 1 - abs(2 * frac(phase / 2) - 1),
}


def piecewise(points, x):
    """Straight lines between (position, values...), held beyond the ends."""
    if x < points[0][0]:
        return points[0][1:]
    for low, high in zip(points, points[1:]):
        if low[0] <= x < high[0]:
            share = (x - low[0]) / (high[0] - low[0])
            return tuple(a + (b - a) * share for a, b in zip(low[1:], high[1:]))
    return points[-1][1:]


class Look:
    def __init__(self, **changes):
        self.place, self.angle, self.size = (0.1, -0.2), 0.5, 1.3
        self.speed, self.width, self.seed = 0.45, 0.3, 42
        self.ease, self.wrap = "smooth", "mirror"
        self.palette = [
            (0.0, 1.0, 0.0, 0.0, 1.0),
            (0.4, 0.1, 0.6, 0.2, 0.8),
            (1.0, 0.0, 0.2, 1.0, 1.0),
        ]
        self.__dict__.update(changes)

    def bend(self, u):
        return EASES[self.ease](clamp(u))


class Robot:
    """The robot that the table asks at moment number k."""

    def __init__(self, k):
        self.index, self.count = (3 * k) % 7, 7
        self.q = (-0.9 + 0.2 * k, 0.7 - 0.15 * k)
        self.speed, self.frame = 0.03 * k, k // 3
        self.colour, self.next = (0.2, 0.1, 0.3), (0.9, 0.5, 0.1)


def local(look, robot):
    dx, dy = robot.q[0] - look.place[0], robot.q[1] - look.place[1]
    c, s = math.cos(look.angle), math.sin(look.angle)
    return dx, dy, dx * c + dy * s, -dx * s + dy * c


CURVE = [(-1.0, 0.8), (0.0, 0.2), (0.5, -0.9)]


def along(kind, look, robot):
    dx, dy, x, _ = local(look, robot)
    if kind == "line":
        return x / look.size
    if kind == "distance":
        return math.hypot(dx, dy) / look.size
    if kind == "angle":
        return frac((math.atan2(dy, dx) - look.angle) / (2 * math.pi))
    if kind == "order":
        return robot.index / robot.count
    best, done = (math.inf, 0.0), 0.0
    for (ax, ay), (bx, by) in zip(CURVE, CURVE[1:]):
        ux, uy = bx - ax, by - ay
        length = math.hypot(ux, uy)
        share = clamp(((robot.q[0] - ax) * ux + (robot.q[1] - ay) * uy) / length**2)
        gap = math.hypot(robot.q[0] - ax - share * ux, robot.q[1] - ay - share * uy)
        best = min(best, (gap, done + share * length))
        done += length
    return best[1] / done


def value_noise(seed, point):
    whole = [math.floor(v) for v in point]
    x, y, z = [(f := v - w) * f * (3 - 2 * f) for v, w in zip(point, whole)]
    total = 0.0
    for dx, wx in ((0, 1 - x), (1, x)):
        for dy, wy in ((0, 1 - y), (1, y)):
            for dz, wz in ((0, 1 - z), (1, z)):
                total += wx * wy * wz * h(seed, whole[0] + dx, whole[1] + dy, whole[2] + dz)
    return total


def noise(seed, point, octaves):
    parts = [value_noise(seed + k, [v * 2**k for v in point]) / 2**k for k in range(octaves)]
    return sum(parts) / sum(2.0**-k for k in range(octaves))


# Two pictures of 3 x 2 pixels, row by row from the top left; sRGB codes of red, green and blue.
FILM = [[[(40 * n + 7 * f, 250 - 30 * n, (90 * n + f) % 256) for n in range(3 * r, 3 * r + 3)] for r in (0, 1)] for f in (0, 1)]


def picture(look, robot, turns):
    _, _, x, y = local(look, robot)
    across, down = 0.5 + x / look.size, 0.5 - y / (look.size * 2 / 3)
    if not (0 <= across <= 1 and 0 <= down <= 1):
        return (0.0, 0.0, 0.0, 0.0)
    rows = FILM[math.floor(frac(turns) * 2)]
    column, row = min(max(across * 3 - 0.5, 0), 2), min(max(down * 2 - 0.5, 0), 1)
    light = [0.0, 0.0, 0.0]
    for r in (0, 1):
        for c in (0, 1, 2):
            weight = max(0, 1 - abs(column - c)) * max(0, 1 - abs(row - r))
            for channel in range(3):
                light[channel] += weight * decode(rows[r][c][channel] / 255)
    return (*light, 1.0)


def value(effect, look, robot, turns, tau):
    name, *own = effect
    phase = frac(turns)
    dx, dy, x, y = local(look, robot)
    x, y, r = x / look.size, y / look.size, math.hypot(dx, dy) / look.size
    wave = lambda n, p: math.sin(2 * math.pi * (p + h(look.seed, n, 0)))
    if name == "solid":
        return 0.0
    if name == "gradient":
        return WRAPS[look.wrap](along(own[0], look, robot) - turns)
    if name == "fade":
        return WRAPS[look.wrap](turns)
    if name == "pulse":
        return phase / look.width if phase < look.width else (1 - phase) / (1 - look.width)
    if name == "strobe":
        return 1.0 if phase < look.width else 0.0
    if name == "twinkle":
        shifted = turns + h(look.seed ^ 0x6F666673, robot.index, 0)
        lit = frac(shifted) < look.width and h(look.seed, robot.index, math.floor(shifted)) < own[0]
        return math.sin(math.pi * frac(shifted) / look.width) ** 2 if lit else 0.0
    if name == "sparkle":
        return 1.0 if h(look.seed, robot.index, math.floor(turns)) < own[0] else 0.0
    if name == "wave":
        return 0.5 + 0.5 * math.cos(2 * math.pi * (along(own[0], look, robot) - turns))
    if name == "chase":
        ahead = turns - along(own[0], look, robot)
        return clamp(1 - frac(ahead if look.speed >= 0 else -ahead) / look.width)
    if name == "ripple":
        return clamp(1 - abs(r - phase) / look.width) * (1 - phase)
    if name == "plasma":
        waves = wave(0, x + phase) + wave(1, y - phase) + wave(2, (x + y) / 2 + 2 * phase) + wave(3, r - phase)
        return 0.5 + waves / 8
    if name == "noise":
        return noise(look.seed, [dx / look.size, dy / look.size, turns], own[0])
    if name == "fire":
        return clamp(1.1 * noise(look.seed, [3 * y, 3 * (x - turns), turns], 2) + 0.25 - x)
    if name == "by-robot":
        return WRAPS[look.wrap](h(look.seed, robot.index, 0) + turns)
    return robot.speed / own[0]


def shade(effect, look, robot, tau):
    """Red, green, blue and opacity."""
    turns = look.speed * tau
    if effect[0] == "rainbow":
        hue = look.bend(frac(along(effect[1], look, robot) - turns))
        code = lambda k: 1 - effect[2] * (1 - clamp(abs((6 * hue + k) % 6 - 3) - 1))
        return (decode(code(0)), decode(code(4)), decode(code(2)), 1.0)
    if effect[0] == "picture":
        return picture(look, robot, turns)
    if effect[0] == "next-frame":
        return (*robot.next, look.bend(WRAPS[look.wrap](turns)))
    return piecewise(look.palette, look.bend(value(effect, look, robot, turns, tau)))


def screen(b, l):
    return 1 - (1 - b) * (1 - l)


BLENDS = {
    "normal": lambda b, l: l,
    "screen": screen,
    "multiply": lambda b, l: b * l,
    "difference": lambda b, l: abs(b - l),
    "overlay": lambda b, l: 2 * b * l if b <= 0.5 else screen(l, 2 * b - 1),
}


def circle(cx, cy, radius, feather):
    return lambda robot: clamp((radius - math.hypot(robot.q[0] - cx, robot.q[1] - cy)) / feather)


def frames(first, last):
    return lambda robot: 1.0 if first <= robot.frame <= last else 0.0


def colour(layers, robot, t):
    light = robot.colour
    for layer in layers:
        start, end = layer.get("from", 0.1), layer.get("to", math.inf)
        if not start <= t < end:
            continue
        *shine, opacity = shade(layer["effect"], layer["look"], robot, t - start)
        opacity *= piecewise(layer.get("opacity", [(0.0, 1.0)]), t - start)[0]
        for mask in layer.get("masks", []):
            opacity *= mask(robot)
        blend = BLENDS[layer.get("blend", "normal")]
        light = tuple(b + (blend(b, l) - b) * opacity for b, l in zip(light, shine))
    return tuple(clamp(channel) for channel in light)


def one(*effect, **changes):
    return [{"effect": effect, "look": Look(**changes)}]


SCENES = {
    "solid": one("solid"),
    "gradient-line": one("gradient", "line"),
    "gradient-distance": one("gradient", "distance", wrap="loop"),
    "gradient-angle": one("gradient", "angle", wrap="loop", speed=-0.2),
    "gradient-still": one("gradient", "line", wrap="once", speed=0.0, ease="out"),
    "fade": one("fade", speed=0.3, wrap="once"),
    "breathe": one("fade", ease="sine"),
    "pulse": one("pulse", ease="in"),
    "strobe": one("strobe", speed=2.9, width=0.4),
    "twinkle": one("twinkle", 0.8, width=0.8),
    "sparkle": one("sparkle", 0.5, speed=10.0),
    "rainbow-order": one("rainbow", "order", 1.0, ease="linear"),
    "rainbow-line": one("rainbow", "line", 0.7),
    "wave-line": one("wave", "line"),
    "wave-distance": one("wave", "distance", ease="linear"),
    "chase-order": one("chase", "order", width=0.6),
    "chase-curve": one("chase", "curve", width=0.9, speed=-0.45),
    "ripple": one("ripple", width=0.5),
    "plasma": one("plasma"),
    "noise": one("noise", 3),
    "fire": one("fire", ease="linear"),
    "picture": one("picture", size=2.4),
    "next-frame": one("next-frame", speed=0.3),
    "by-robot": one("by-robot", wrap="loop"),
    "by-speed": one("by-speed", 0.25),
    "stack": [
        {"effect": ("rainbow", "line", 0.9), "look": Look(ease="linear"), "from": 0.0, "to": 3.0},
        {
            "effect": ("wave", "distance"),
            "look": Look(speed=-0.8, seed=1),
            "blend": "screen",
            "masks": [circle(0.0, 0.0, 1.1, 0.4)],
            "opacity": [(0.5, 0.2), (1.5, 1.0), (3.0, 0.4)],
        },
        {"effect": ("noise", 2), "look": Look(seed=9), "blend": "overlay", "masks": [frames(1, 2)]},
        {"effect": ("plasma",), "look": Look(seed=5), "blend": "difference", "from": 2.0},
        {"effect": ("by-robot",), "look": Look(), "blend": "multiply", "opacity": [(0.0, 0.5)]},
    ],
}


def main():
    print("scene,moment,t_s,red,green,blue")
    for name, layers in SCENES.items():
        for k in range(MOMENTS):
            t = 0.13 + 0.37 * k
            red, green, blue = colour(layers, Robot(k), t)
            print(f"{name},{k},{t:.2f},{red:.12f},{green:.12f},{blue:.12f}")


main()
