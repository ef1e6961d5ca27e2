"""Laws as formulas, one per file: forces, computed with numbers and with series alike."""
