"""The environment for learning."""

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")
import frond  # noqa: E402
import frond.gym  # noqa: E402


@pytest.fixture
def env():
    env = frond.gym.ReachThroughLeaves(render_mode="rgb_array")
    yield env
    env.close()


def greedy(env, seen):
    """Returns an action that goes straight to the target, by PyBullet's inverse kinematics."""
    import pybullet as p

    pose = p.calculateInverseKinematics(env.arm, frond.gym.HAND, env.target.tolist(), physicsClientId=env.client)
    return np.clip((np.array(pose) - env.wanted) * 240 / env.steps / env.speed, -1, 1)


def test_it_is_an_environment(env):
    from gymnasium.utils.env_checker import check_env

    check_env(env, skip_render_check=True)
    assert env.render().shape == (360, 480, 3)


def test_a_straight_way_touches_leaves_and_reaches_some_targets(env):
    reached, touched = 0, 0.0
    for seed in range(4):
        seen, _ = env.reset(seed=seed)
        total = 0.0
        for _ in range(60):
            seen, reward, ended, cut, info = env.step(greedy(env, seen))
            touched = max(touched, float(seen[-2]))
            total += reward
            if ended or cut:
                break
        reached += info["reached"]
        assert np.isfinite(total)
    assert reached >= 2 and touched > 0.1


def test_episodes_repeat_by_seed_and_replay_from_a_snapshot(env):
    def run(steps):
        seen = [env.step(greedy(env, None))[0] for _ in range(steps)]
        return np.array(seen)

    env.reset(seed=3)
    first = run(20)
    env.reset(seed=3)
    by_seed = np.abs(run(20) - first).max()
    env.reset(seed=3)
    run(10)
    saved = env.save()
    once = run(10)
    env.restore(saved)
    replay = np.abs(run(10) - once)[:, :14].max()
    env.restore(saved)
    again = np.abs(run(10) - once)[:, :14].max()
    print(f"an episode repeats to {by_seed:.1e}, a replay's joints to {replay:.1e} and {again:.1e} rad, rad/s")
    assert by_seed == 0 and max(replay, again) < 1e-3


def test_it_is_vectorised_by_processes():
    envs = gymnasium.make_vec("frond/ReachThroughLeaves-v0", num_envs=2, vectorization_mode="async")
    try:
        seen, _ = envs.reset(seed=[1, 1])
        assert np.array_equal(seen[0], seen[1])
        for _ in range(3):
            seen, reward, *_ = envs.step(np.zeros((2, 7), np.float32))
        assert seen.shape == (2, 25) and np.array_equal(seen[0], seen[1])
    finally:
        envs.close()


def test_wrong_use_is_refused_with_a_remedy():
    for options in ({"mechanics": "glue"}, {"speed": float("nan")}, {"speed": "fast"}, {"steps": 0}, {"limit": 1.5},
                    {"render_mode": "human"}):
        with pytest.raises(frond.Error, match="pass"):
            frond.gym.ReachThroughLeaves(**options)
    env = frond.gym.ReachThroughLeaves()
    with pytest.raises(frond.Error, match="reset"):
        env.step(np.zeros(7))
    env.reset(seed=1)
    for action in (None, np.zeros(6), [np.nan] * 7, "left", {}):
        with pytest.raises(frond.Error, match="action"):
            env.step(action)
    for target in ((1, 2), "there", (0, 0, np.inf)):
        with pytest.raises(frond.Error, match="target"):
            env.reset(options={"target": target})
    with pytest.raises(frond.Error, match="save"):
        env.restore(None)
    env.close()
    for call in (env.reset, lambda: env.step(np.zeros(7)), lambda: env.restore(None)):
        with pytest.raises(frond.Error, match="closed"):
            call()
