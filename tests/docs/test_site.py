"""The site: what checks it notices what is wrong."""

from __future__ import annotations

from docs.check_links import broken


def test_a_link_that_leads_nowhere_is_found(tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/other.html").write_text('<h1 id="here">x</h1><a href="../page.html">y</a>')
    page = '<a href="sub/other.html#{}"><img src="{}"></a><a href="https://x.y/z">z</a>'
    (tmp_path / "page.html").write_text(page.format("here", "sub/other.html"))
    assert broken(tmp_path) == []
    (tmp_path / "page.html").write_text(page.format("there", "no.png"))
    assert broken(tmp_path) == ["page.html: no.png", "page.html: sub/other.html#there"]
