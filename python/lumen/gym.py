"""A Gymnasium environment whose guidewire Lumen simulates in any vessel (docs/serve.md). Not for clinical decisions.

    python -m lumen.gym FILE

steers by two policies, random and scripted, and prints what came of each. Needs gymnasium.
"""
import sys
import time

import gymnasium
import numpy as np

import lumen

#: Decisions of 0.02 s in one step of the environment.
REPEAT = 5
#: Steps after which an episode is cut off: two minutes of simulated time.
MOST_STEPS = 1200
SEEN = ["tip_mm", "tip_direction", "tip_side", "inserted_mm", "roll_rad", "push_n", "torque_n_mm", "wall_force_n", "route_mm",
        "target_mm", "is_wrong_branch", "is_looped"]


class GuidewireEnv(gymnasium.Env):
    """Action: feed and roll, each -1 to 1 of its largest. Observation: SEEN in one array. Reward: mm nearer to the target along
    the route, less a tenth of the wall force in N; 100 for arriving.

    `surface` and `options` are those of `lumen.Guidewire`; `repeat` is the number of decisions of 0.02 s in a step."""

    metadata = {"render_modes": []}

    def __init__(self, surface, *, repeat=REPEAT, **options):
        self.guidewire, self.repeat = lumen.Guidewire(surface, **options), repeat
        first = self.guidewire.about()
        self.most = np.array([first["trial"]["most_feed_mm_s"], first["trial"]["most_roll_rad_s"]])
        self.action_space = gymnasium.spaces.Box(-1, 1, (2,), np.float32)
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, self._seen(first).shape, np.float32)
        self.steps = 0

    def _seen(self, answer):
        self.observation = answer["observation"]
        return np.hstack([self.observation[name] for name in SEEN]).astype(np.float32)

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        self.steps = 0
        asked = dict(options or {})
        if seed is not None:
            asked["seed"] = seed
        answer = self.guidewire.ask(reset=asked)
        return self._seen(answer), answer["trial"]

    def step(self, action):
        before = self.observation["route_mm"]
        feed, roll = (np.clip(action, -1, 1) * self.most).tolist()
        seen = self._seen(self.guidewire.ask(step={"feed_mm_s": feed, "roll_rad_s": roll, "repeat": self.repeat}))
        now, self.steps = self.observation, self.steps + 1
        reward = now["route_mm"] - before - 0.1 * now["wall_force_n"] + 100 * now["has_arrived"]
        return seen, float(reward), now["has_arrived"], self.steps >= MOST_STEPS, {}


def scripted(env):
    """Feeds; in a wrong branch or a loop it withdraws for a second, and rolls."""
    backwards = 0
    while True:
        if backwards == 0 and (env.observation["is_wrong_branch"] or env.observation["is_looped"]):
            backwards = 10
        yield [-0.4, 0.1] if backwards > 0 else [0.2, 0.0]
        backwards = max(backwards - 1, 0)


def chance(env):
    """Anything."""
    while True:
        yield env.action_space.sample()


def episode(env, policy, seed=1):
    """Steers to the end; the reward in all, whether the wire arrived, and the steps of the solver a second."""
    env.reset(seed=seed)
    env.action_space.seed(seed)
    total, begun = 0.0, time.perf_counter()
    for action in policy(env):
        _, reward, has_arrived, is_late, _ = env.step(action)
        total += reward
        if has_arrived or is_late:
            return total, has_arrived, env.observation["steps"] / (time.perf_counter() - begun)


def main():
    # The smoothing of `lumen trial`, which leaves vessels of 1.5 mm open.
    vessel = lumen.read(sys.argv[1]).optimise(smoothing="paper", pass_band=0.1, iterations=30, reduction=90).reduced
    env = GuidewireEnv(vessel)
    for name, policy in [("random", chance), ("scripted", scripted)]:
        total, has_arrived, speed = episode(env, policy)
        now = env.observation
        print(f"{name}: {'arrived' if has_arrived else 'cut off'} after {now['time_s']:.1f} s, {now['target_mm']:.1f} mm from the "
              f"target, reward {total:.0f}, {env.steps} steps, {speed:.0f} solver steps a second")


if __name__ == "__main__":
    main()
