"""Calls that take long: they let Python go on, report their progress, and end on request."""
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import eyeray

SMALL = "tests/library/small.toml"
LONG = ["image.pattern=random", "image.samples=65536"]


def test_progress_reports_and_cancels():
    seen = []

    def progress(share):
        seen.append(share)
        return len(seen) < 3

    picture = eyeray.render(eyeray.Scene.read(SMALL, defines=LONG), progress=progress)
    assert len(seen) == 3 and seen == sorted(seen) and 0 < seen[0] <= 1
    assert not picture.complete and 0 < picture.samples_done < 65536 and picture.color.shape == (48, 64, 3)
    assert eyeray.render(eyeray.Scene.read(SMALL), progress=lambda share: None).complete


def test_exceptions_of_progress_propagate():
    with pytest.raises(KeyError, match="mine"):
        eyeray.render(eyeray.Scene.read(SMALL), progress=lambda share: {}["mine"])
    with pytest.raises(TypeError):
        eyeray.render(eyeray.Scene.read(SMALL), progress=3)
    assert eyeray.render(eyeray.Scene.read(SMALL)).complete


def test_cancellation_from_another_thread():
    cancellation = eyeray.Cancellation()
    assert not cancellation.requested
    timer = threading.Timer(0.3, cancellation.request)
    timer.start()
    picture = eyeray.render(eyeray.Scene.read(SMALL, defines=LONG), cancellation=cancellation)
    timer.join()
    assert cancellation.requested and not picture.complete
    empty = eyeray.render(eyeray.Scene.read(SMALL), cancellation=cancellation)
    assert empty.samples_done == 0 and empty.color.size == 0 and empty.aovs == ()
    with pytest.raises(eyeray.CancelledError):
        eyeray.verify(eyeray.Scene.read(SMALL), cancellation=cancellation)


def test_python_threads_run_during_a_render():
    turns, done = 0, threading.Event()

    def count():
        nonlocal turns
        while not done.is_set():
            turns += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    at_first = []
    # Waits until it has, however busy the machine is.
    eyeray.render(eyeray.Scene.read(SMALL, defines=LONG), progress=lambda share: at_first.append(turns) or at_first[-1] == at_first[0])
    done.set()
    counter.join()
    assert at_first[-1] > at_first[0]  # between two calls of progress, not only in them


def test_pictures_from_several_threads():
    scene = eyeray.Scene.read(SMALL)
    expected = eyeray.render(scene).color
    results = []

    def work():
        own = eyeray.Renderer(device="0")  # found and closed here, while others render
        results.append(np.array_equal(own.render(scene, progress=lambda share: True).color, expected))

    threads = [threading.Thread(target=work) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert results == [True] * 3


def test_calls_share_a_thread():
    seen = set()
    for _ in range(3):
        eyeray.render(eyeray.Scene.read(SMALL), progress=lambda share: seen.add(threading.get_native_id()))
    assert len(seen) == 1 and threading.get_native_id() not in seen


def test_a_call_within_progress_is_refused():
    scene = eyeray.Scene.read(SMALL)
    refused = []

    def progress(share):
        for call in (lambda: eyeray.render(scene), lambda: eyeray.Scene.read(SMALL), lambda: eyeray.verify(scene)):
            with pytest.raises(eyeray.InputError, match="within `progress`") as error:
                call()
            refused.append(error)
        eyeray.Renderer(timeout=5)  # opens nothing, and closes nothing
        return False

    eyeray.render(scene, progress=progress)
    assert len(refused) == 3
    assert eyeray.render(scene).complete


def test_a_thread_that_progress_waits_for_is_refused():
    """It would wait for the end of the call that waits for it."""
    scene = eyeray.Scene.read(SMALL)
    ended = []

    def work():
        with pytest.raises(eyeray.InputError, match="has not returned for 10 seconds"):
            eyeray.render(scene)
        ended.append("refused")

    def progress(share):
        for target in (lambda: ended.append("calls nothing"), work):
            thread = threading.Thread(target=target)
            thread.start()
            thread.join()
        return False

    eyeray.render(scene, progress=progress)
    assert ended == ["calls nothing", "refused"]
    assert eyeray.render(scene).complete


def test_a_forked_child_uses_no_device_of_its_parent():
    code = f"""
import eyeray, os, sys
scene = eyeray.Scene.read({SMALL!r})
eyeray.render(scene)
child = os.fork()
if child == 0:
    try:
        eyeray.render(scene)
    except eyeray.DeviceError as error:
        sys.exit(3 if "forked" in str(error) and eyeray.render(scene, backend="twin").complete else 4)
    sys.exit(5)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), eyeray.render(scene).complete)
"""
    process = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=600)
    assert process.stdout == "3 True\n", process.stderr


def test_a_forked_child_reads_scenes():
    eyeray.Scene.read(SMALL)
    child = os.fork()
    if child == 0:
        os._exit(eyeray.Scene.read(SMALL).width)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 64


def test_ctrl_c():
    code = f"import eyeray; s = eyeray.Scene.read({SMALL!r}, defines={LONG}); print('go', flush=True); eyeray.render(s)"
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "go\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    errors = process.communicate(timeout=600)[1]
    assert errors.rstrip().endswith("KeyboardInterrupt") and process.returncode == -signal.SIGINT


def test_ctrl_c_does_not_wait_for_a_driver():
    """A slow progress callback stands for a driver that compiles: an interrupt does not wait for either."""
    code = f"""
import eyeray, signal, threading, time
scene = eyeray.Scene.read({SMALL!r}, defines={LONG})
held, called = threading.Event(), threading.Event()
def progress(share):
    called.set()
    held.wait()
threading.Thread(target=lambda: (called.wait(), signal.raise_signal(signal.SIGINT)), daemon=True).start()
try:
    eyeray.render(scene, progress=progress)
except KeyboardInterrupt:
    print("free", called.is_set(), held.is_set(), flush=True)
held.set()
print(eyeray.render(eyeray.Scene.read({SMALL!r})).complete)
"""
    process = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=600)
    assert (process.stdout, process.returncode) == ("free True False\nTrue\n", 0), process.stderr


def test_python_ends_while_a_kernel_compiles(tmp_path):
    """The thread of the abandoned call then closes the device, after Python has ended."""
    code = """
import eyeray, signal, threading
scene = eyeray.Scene.read("scenes/path/materials.toml", defines=["image.width=8", "image.height=8"])
threading.Timer(0.5, signal.raise_signal, [signal.SIGINT]).start()
try:
    eyeray.render(scene)
except KeyboardInterrupt:
    print("interrupted")
"""
    caches = {"XDG_CACHE_HOME": str(tmp_path), "MESA_SHADER_CACHE_DISABLE": "true"}
    process = subprocess.run([sys.executable, "-c", code], env=os.environ | caches, capture_output=True, text=True, timeout=600)
    assert (process.stdout, process.stderr, process.returncode) == ("interrupted\n", "", 0)


def test_errors_of_renderers():
    """They name options as Python does, and the constructor raises them."""
    with pytest.raises(eyeray.DeviceError, match="matches `device` no such device; the devices are\\n  0  "):
        eyeray.Renderer(device="no such device")
    with pytest.raises(eyeray.FileError):
        eyeray.Renderer(shaders="no-such-folder")
    with pytest.raises(eyeray.InputError, match="^`timeout` must be from 0.001 to 1000000 seconds, not -1$"):
        eyeray.Renderer(timeout=-1)
    scene = eyeray.Scene.read(SMALL)
    assert eyeray.Renderer(device="0").render(scene).complete
    with pytest.raises(eyeray.InputError, match="^the picture has no AOV 'depth'; request it by the option `aovs` of the render$"):
        eyeray.render(scene, backend="twin").aov("depth")
    with pytest.raises(eyeray.InputError, match='albedo and shading_normal: set integrator = "path" in .render., or request'):
        eyeray.render(scene, backend="twin", aovs=["albedo"])


def test_environment_variables_are_unchanged():
    before = dict(os.environ)
    eyeray.render(eyeray.Scene.read(SMALL))
    assert dict(os.environ) == before
