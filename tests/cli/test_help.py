"""Help topics, to which the help of the commands refers."""

from __future__ import annotations

from dataclasses import fields

import pytest
from docstring_parser import parse_from_object

from vibroimpact.cli import main
from vibroimpact.cli.options import OutputOptions, RigOptions
from vibroimpact.cli.topics import TOPICS

GROUPS = {"rigs": RigOptions, "output": OutputOptions}


@pytest.mark.parametrize("topic", GROUPS)
def test_a_topic_explains_every_option_of_its_group(topic, capsys):
    assert main(["help", topic]) == 0
    text = capsys.readouterr().out
    for field in fields(GROUPS[topic]):
        option = "set" if field.name == "values" else field.name.replace("_", "-")
        assert f"--{option}" in text, option


@pytest.mark.parametrize("group", GROUPS.values())
def test_a_command_has_one_line_for_each_of_them(group):
    for one in parse_from_object(group).params:
        assert len(one.description) < 90, one.arg_name


def test_topics_are_listed(capsys):
    assert main(["help"]) == 0
    text = capsys.readouterr().out
    assert all(f"{name} " in text and one.summary in text for name, one in TOPICS.items())


def test_commands_and_the_first_help_refer_to_the_topics(capsys):
    for words in (["--help"], ["sweep", "--help"]):
        assert main(words) == 0
        text = " ".join(capsys.readouterr().out.split())
        assert all(f"vibroimpact help {name}" in text for name in TOPICS)


def test_help_of_a_command(capsys):
    assert main(["help", "sweep"]) == 0
    text = capsys.readouterr().out
    assert main(["sweep", "--help"]) == 0
    assert text == capsys.readouterr().out


@pytest.mark.parametrize(
    ("topic", "advice"),
    [
        ("rig", "did you mean rigs? Or run vibroimpact help, which lists the topics"),
        ("swep", "did you mean sweep? Or run vibroimpact help, which lists the topics"),
        ("xyz", "run vibroimpact help, which lists the topics"),
    ],
)
def test_an_unknown_topic(topic, advice, capsys):
    assert main(["help", topic]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err == f"vibroimpact: error: help: unknown topic {topic!r}; {advice}\n"
