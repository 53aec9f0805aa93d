"""The code of docs/python.md works: its blocks run one after the other, as in a notebook."""
import contextlib
import io
import pathlib
import re



BLOCK = re.compile(r"```python\n(.*?)```(?:\n+```text\n(.*?)```)?", re.DOTALL)


def test_every_block_runs(tmp_path, monkeypatch):
    text = pathlib.Path("docs/python.md").read_text()
    blocks = BLOCK.findall(text)
    assert len(blocks) >= 6 and text.count("```python\n") == len(blocks)
    (tmp_path / "scenes").symlink_to(pathlib.Path("scenes").resolve())
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "tutorial"}
    for code, shown in blocks:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(code, "docs/python.md", "exec"), names)
        if shown:
            assert printed.getvalue() == shown, code
