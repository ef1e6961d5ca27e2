"""u (m) and v (m/s) of the rigs of `law_cases` after 1, 5 and 20 cycles from rest.

Written by `store_law_states.py`, from a run to forty digits; all digits are right.
"""

STATES: dict[str, tuple[tuple[str, str], ...]] = {
    "linear, bumpers": (
        ("0.00201139012529643349554055", "-0.05424275915008231511294948"),
        ("0.003333728435331046257820616", "-0.04556711481553324596110056"),
        ("0.003338515745708264061434053", "-0.04515560546264806517996739"),
    ),
}
