"""Sweeps and rollouts on a cluster of two nodes."""

import os
import signal
import time

import pytest

ray = pytest.importorskip("ray")
from frond import sweep  # noqa: E402


@pytest.fixture(scope="module")
def cluster():
    from ray.cluster_utils import Cluster

    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1, "include_dashboard": False})
    cluster.add_node(num_cpus=1)
    ray.init(address=cluster.address, log_to_driver=False)
    assert len([node for node in ray.nodes() if node["Alive"]]) == 2
    yield cluster.address
    ray.shutdown()
    cluster.shutdown()


def without_times(results):
    return [{name: value for name, value in result.items() if name != "cpu"} for result in results]


@pytest.mark.parametrize("name, some", [("accuracy", slice(0, 3)), ("stiffness", slice(0, 3)), ("wind", slice(0, 4))])
def test_a_cluster_gives_the_results_of_one_process(cluster, name, some):
    function, cases = sweep.SWEEPS[name]
    assert without_times(sweep.run(function, cases[some], cluster)) == \
        without_times(sweep.run(function, cases[some], workers=0))


def test_rollouts_are_played_by_actors(cluster):
    cases = [{"seed": seed, "decisions": 10} for seed in range(4)]
    assert sweep.play(cases, cluster, workers=2) == sweep.play(cases, workers=0)


def test_what_a_killed_worker_did_is_done_again(cluster, tmp_path):
    def die_once(marker, number):
        if number == 1 and not os.path.exists(marker):
            open(marker, "w").close()
            os.kill(os.getpid(), signal.SIGKILL)
        return sweep.wind(speed=float(number))

    cases = [{"marker": str(tmp_path / "died"), "number": number} for number in range(3)]
    results = sweep.run(die_once, cases, cluster)
    assert (tmp_path / "died").exists()
    assert results == [sweep.wind(speed=float(number)) for number in range(3)]

    actors = sweep.players(2, cluster)
    process = ray.get(actors[0].process.remote())
    seeds = [{"seed": seed, "decisions": 10} for seed in range(4)]
    played = [actors[i % 2].play.remote(**case) for i, case in enumerate(seeds)]
    time.sleep(1)
    os.kill(process, signal.SIGKILL)
    assert ray.get(played) == sweep.play(seeds, workers=0)
    assert ray.get(actors[0].process.remote()) != process


def test_it_prints_csv(capsys):
    sweep.main(["stiffness", "--workers", "0"])
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "factor,bend,air" and len(lines) == 6
    bends = [float(line.split(",")[1]) for line in lines[1:]]
    assert bends == sorted(bends, reverse=True)
