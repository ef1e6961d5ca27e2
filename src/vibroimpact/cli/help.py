"""``vibroimpact help``: a help topic, or the help of a command."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from vibroimpact.cli.function_options import calls
from vibroimpact.errors import InputError, meant, shown


@calls(None, "Help")
def help(topic: Annotated[str, Parameter(name="TOPIC")] = "", /) -> int:
    """Explain a topic, such as the options that many commands share.

    For example:

        vibroimpact help
        vibroimpact help rigs
        vibroimpact help sweep

    Parameters
    ----------
    topic
        Name of the topic, or of a command, whose help is printed. Default: topics are listed.
    """
    from vibroimpact.cli import print_help
    from vibroimpact.cli.topics import TOPICS

    if not topic:
        width = max(map(len, TOPICS))
        print("Topics")
        for name, one in TOPICS.items():
            print(f"  {name:{width}}  {one.summary}")
        print("\nTo read one, run: vibroimpact help TOPIC")
    elif topic in TOPICS:
        from rich.console import Console
        from rich.markdown import Markdown

        Console().print(Markdown(TOPICS[topic].text))
    elif (commands := print_help(topic)) is not None:
        hint = meant(topic, [*TOPICS, *commands])
        raise InputError(
            f"help: unknown topic {shown(topic)}; {hint}{'Or run' if hint else 'run'} "
            "vibroimpact help, which lists the topics"
        )
    return 0
