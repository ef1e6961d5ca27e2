"""The explorer: a page in a browser with a knob for each parameter of a rig.

Each page has one session, and each session has one immutable state::

    state.py      the state of a page, and the states for undo and redo
    controls.py   the knobs of a state, with their ranges
    change.py     functions that return the next state
    presets.py    the states from which a page can start
    pictures/     functions that compute the pictures of a state, one file per picture
    session.py    the requests of one page, of which only the newest is computed
    server.py     the server of the pages and their sessions
    share.py      a state as an address, a study file and a program

The page itself (HTML, CSS, JavaScript) is in ``page/``. It draws the pictures that it gets, and
computes nothing. Without a server they come from a worker, whose program is in ``worker/``, and
whose engine is a module of WebAssembly::

    engine_layout.py  what the worker has to know of the engine
    offline_facts.py  what it has to know of the package: presets, knobs, units, limits, words
    offline_page.py   all of that as one HTML file
"""
