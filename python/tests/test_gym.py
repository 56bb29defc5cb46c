"""The Gymnasium environment, by a random and a scripted policy."""
import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")


@pytest.fixture(name="env", scope="module")
def of_a_tube(vessel):
    from lumen.gym import GuidewireEnv
    return GuidewireEnv(vessel.reduced)


@pytest.mark.filterwarnings("ignore:.*A Box observation space")
def test_it_is_an_environment(env):
    from gymnasium.utils.env_checker import check_env
    check_env(env, skip_render_check=True)


def test_the_scripted_policy_arrives_and_the_random_one_stays_inside(env):
    from lumen.gym import chance, episode, scripted
    reward, has_arrived, _ = episode(env, scripted)
    assert has_arrived and reward > 100
    episode(env, lambda env: [next(chance(env)) for _ in range(100)] + [[1, 0]] * 1200)
    assert np.isfinite(env.observation["wall_force_n"])


def test_the_same_actions_are_seen_the_same(env):
    def seen(seed):
        first, about = env.reset(seed=seed)
        assert about["seed"] == seed
        return np.vstack([first] + [env.step([0.3, 0.1])[0] for _ in range(20)])

    assert (seen(3) == seen(3)).all()
    assert (seen(3) != seen(4)).any()
