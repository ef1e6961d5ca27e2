"""The flow of linear laws: closed-form motion from tables, certified events, pieces."""
