"""Progress of a whole study: points, pace, time left and failures, in one line, from counts that jobs write."""

import io
import logging
import time

import pytest

from subslide.study import progress


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def home(tmp_path):
    return tmp_path


def record(event=None, message="", **values):
    """A line of Snakemake's."""
    made = logging.LogRecord("snakemake", logging.INFO, "", 0, message, (), None)
    vars(made).update(event=event, **values)
    return made


def test_counts_of_all_jobs_make_one_line(home):
    reporter = progress.Reporter(home, {"0001": (100, 30.0), "0002": (900, 10.0)}, io.StringIO())
    assert reporter.line() == "0 of 1,000 points, 1 s"
    first, second = (progress.Counter(progress.counter_path(home, name)) for name in ("0001", "0002"))
    for n in range(20):
        first.add(failed=n < 2)
    first.write()
    assert reporter.line() == "20 of 1,000 points, 1 s, 2 failed"
    then, *rest = reporter._first
    reporter._first = (then - 10, *rest)  # ten seconds for a half of all that is to be solved
    for _ in range(60):
        first.add(failed=False)
    for _ in range(90):
        second.add(failed=False)
    first.write()
    second.write()
    reporter.shows(record("progress", done=3, total=9))
    line = reporter.line()
    assert line.startswith("170 of 1,000 points, 15 a second, about ")
    assert line.endswith("s left, 2 failed, 3 of 9 jobs")
    assert 7.5 <= float(line.split("about ")[1].split()[0]) <= 8.5  # 15 of 40 seconds are left, 19 took ten


@pytest.mark.parametrize("text", ["", "5", "x y", "5 0 0", None])
def test_a_count_that_cannot_be_read_stays_as_it_was(home, text):
    reporter = progress.Reporter(home, {"0001": (10, 1.0)}, io.StringIO())
    path = progress.counter_path(home, "0001")
    path.write_text("4 1\n")
    assert reporter.line().startswith("4 of 10 points")
    path.unlink() if text is None else path.write_text(text)
    assert reporter.line().startswith("4 of 10 points")


def test_a_terminal_has_one_line_and_a_log_few(home, monkeypatch):
    monkeypatch.setattr(progress, "OFTEN", 0.01)
    monkeypatch.setenv("TERM", "xterm")
    lines = {}
    for stream in (Terminal(), io.StringIO()):
        reporter = progress.Reporter(home, {"0001": (10, 1.0)}, stream)
        progress.counter_path(home, "0001").write_text("9 9\n")  # of a run before
        reporter.start()
        time.sleep(0.2)
        reporter.stop()
        lines[type(stream)] = stream.getvalue()
    assert lines[io.StringIO] == "0 of 10 points, 1 s\n"
    assert lines[Terminal].count("\n") == 1
    assert lines[Terminal].count("\r") > 3


def test_lines_on_jobs_are_hidden_and_others_are_not(home):
    hidden = [
        record("job_info"),
        record("job_finished"),
        record("progress"),
        record(None, "Execute 2 jobs..."),
    ]
    shown = [record("error"), record("job_error"), record(None, "WorkflowError"), record("run_info")]
    reporter = progress.Reporter(home, {"0001": (1, 1.0)}, io.StringIO())
    assert not any(map(reporter.shows, hidden))
    assert all(map(reporter.shows, shown))
    assert all(map(progress.Reporter(home, {}, io.StringIO()).shows, hidden))  # tables alone are made


def test_nothing_to_solve_tells_nothing(home):
    stream = io.StringIO()
    reporter = progress.Reporter(home, {}, stream)
    reporter.start()
    reporter.stop()
    assert stream.getvalue() == ""


@pytest.mark.parametrize(("seconds", "words"), [(0, "1 s"), (89, "89 s"), (90, "1.5 min"), (5400, "1.5 h")])
def test_durations_are_short(seconds, words):
    assert progress.duration(seconds) == words
