import os
import subprocess

import pytest

import mms_slam

SCENE = "sim:rack_aisle?frames=24&width=320"


@pytest.fixture(scope="session")
def mms():
    """Runs the program; its standard output, or the text of its error."""
    def run(*words, fails=False):
        done = subprocess.run([os.environ["MMS"], *map(str, words)], capture_output=True, text=True,
                              check=False)
        assert (done.returncode != 0) == fails, done.stderr
        return done.stderr if fails else done.stdout
    return run


@pytest.fixture(scope="session")
def folder_of(mms, tmp_path_factory):
    """Results of mms run on a scene, made once."""
    folders = {}

    def run(scene, *words):
        if (scene, words) not in folders:
            folders[scene, words] = tmp_path_factory.mktemp("run") / "results"
            mms("run", scene, "-o", folders[scene, words], *words)
        return folders[scene, words]
    return run


@pytest.fixture(scope="session")
def frames():
    return list(mms_slam.Recording(SCENE))


@pytest.fixture
def slam(frames):
    return mms_slam.Slam(calibration=frames[0].calibration)
