"""Small made-up files in the layouts of the formats."""

from __future__ import annotations

from collections.abc import Sequence

VALUES = [0.5, -1.25, 2.0, -3.5, 0.25, 1.0, -0.75, 0.125, 0.0, -0.0625]
"""What each of them holds, in its own unit."""


def lines_of(texts: Sequence[str], each: int) -> list[str]:
    """So many texts a line."""
    return ["".join(texts[i : i + each]) for i in range(0, len(texts), each)]


def peer(
    announced: str = "NPTS=     10, DT=   .0100 SEC,",
    each: int = 5,
    stated: str = "ACCELERATION TIME SERIES IN UNITS OF G",
) -> list[str]:
    return [
        "PEER NGA STRONG MOTION DATABASE RECORD",
        "Made up, 01/02/2003, Nowhere - Main Street, 045",
        stated,
        announced,
        *lines_of([f"{v:15.7E}" for v in VALUES], each),
    ]


def smc(width: int = 10) -> list[str]:
    integers = ["    -32768"] * 48
    integers[15], integers[16] = f"{1:10d}", f"{10:10d}"
    reals = ["  0.1700000E+39"] * 50
    reals[1] = "  0.1000000E+03"
    short = [f"{v:10.4E}".replace("E+0", "E+").replace("E-0", "E-").rjust(10) for v in VALUES]
    values = lines_of(short, 8) if width == 10 else lines_of([f"{v:14.7E}" for v in VALUES], 5)
    return [
        "2 CORRECTED ACCELEROGRAM",
        "*",
        "NWH",
        *["*"] * 3,
        "station = Nowhere, Main Street         component=    45",
        *["*"] * 4,
        *lines_of(integers, 8),
        *lines_of(reals, 5),
        "| made up",
        *values,
    ]


def cosmos(component: str = "45 Deg", unit: str = "cm/sec2(04)") -> list[str]:
    reals = ["  -999.000000"] * 100
    reals[61] = "    10.000000"
    return [
        "Corrected acceleration    (Format v01.20 with 13 text lines)",
        *["text"] * 3,
        "Statn No: 01-00001  Code:XX-NWH  XX Nowhere - Main Street",
        *["text"] * 3,
        f"Sta Chan  1: {component} (Rcrdr Chan  1) Location:",
        *["text"] * 4,
        " 100 Integer-header values follow on  10 lines, Format= (10I8)",
        *lines_of(["    -999"] * 100, 10),
        " 100 Real-header values follow on  17 lines, Format= (6F13.6)",
        *lines_of(reals, 6),
        '   1 Comment line(s) follow, each starting with a "|":',
        "|<SCNL>NWH.HNZ.XX.--",
        f"   10  acceleration pts, approx   0 secs, units={unit},Format=(8F10.5)",
        *lines_of([f"{v:10.5f}" for v in VALUES], 8),
        "End-of-data for Chan  1 acceleration",
    ]


def csmip(
    number: int = 1,
    towards: str = "45 DEG",
    above: str = "   10 POINTS OF ACCEL DATA EQUALLY SPACED AT  .010 SEC.  (UNITS: CM/SEC/SEC)",
    corrected: bool = True,
) -> list[str]:
    values = lines_of([f"{v:10.4f}" for v in VALUES], 8)
    more = [
        "   10 POINTS OF VELOC DATA EQUALLY SPACED AT  .010 SEC.  (UNITS: CM/SEC)",
        *values,
        "   10 POINTS OF DISPL DATA EQUALLY SPACED AT  .010 SEC.  (UNITS: CM)",
        *values,
    ]
    return [
        *(["CORRECTED ACCELEROGRAM   00001   FROM"] if corrected else []),
        "UNCORRECTED ACCELEROGRAM DATA              PROCESSED:  1/02/03",
        "MADE UP",
        "STATION NO. 00001   35.908N, 120.458W     SMA-1  S/N 4384",
        "NOWHERE - MAIN STREET      CGS",
        f"CHAN  {number}:  {towards}",
        "    1    1    1    3    3    0    1    1    0    0    0    0    0    0    0    0",
        "      .041      .630    65.000      .030      .100     1.870     -.275    10.947",
        above,
        *values,
        *(more if corrected else []),
        f"/&  ----------  END OF DATA FOR CHANNEL  {number}  ----------",
    ]


def geonet(component: str = "N45E", corrected: bool = True) -> list[str]:
    integers = [0] * 40
    integers[33] = 10
    integers[34] = integers[35] = 10 if corrected else 0
    reals = [0.0] * 60
    reals[25] = 0.01
    values = lines_of([f"{v:8.4f}" for v in VALUES], 10)
    return [
        f"{'Corrected' if corrected else 'Uncorrected'} accelerogram 2003 GNS Science",
        "Site NWH       41 45 45S  172 54 19E     Basalt file:  2003_NWH",
        "Nowhere, Main Street",
        *["text"] * 9,
        f"Component {component}  Longitudinal Accelerometer Axis",
        *["text"] * 3,
        *lines_of([f"{n:8d}" for n in integers], 10),
        *lines_of([f"{x:8.4f}" for x in reals], 10),
        *values * (3 if corrected else 1),
    ]


def knet(direction: str = "N-S", scale: str = "2000(gal)/8000") -> list[str]:
    counts = [f"{16000 * v / 4 + 4000:9.0f}" for v in VALUES]
    return [
        "Origin Time       2003/01/02 03:04:05",
        "Lat.              41.010",
        "Long.             142.447",
        "Depth. (km)       34",
        "Mag.              6.3",
        "Station Code      NWH001",
        "Station Lat.      41.5267",
        "Station Long.     140.9244",
        "Station Height(m) 19",
        "Record Time       2003/01/02 03:04:15",
        "Sampling Freq(Hz) 10Hz",
        "Duration Time(s)  1",
        f"Dir.              {direction}",
        f"Scale Factor      {scale}",
        "Max. Acc. (gal)   3.5",
        "Last Correction   2003/01/02 03:04:15",
        "Memo.",
        *lines_of(counts, 8),
    ]


def esm() -> list[str]:
    return [
        "EVENT_NAME: Made up",
        "EVENT_DATE_YYYYMMDD: 20030102",
        "NETWORK: XX",
        "STATION_CODE: NWH",
        "STATION_NAME: Nowhere",
        "SAMPLING_INTERVAL_S: 0.010000",
        "NDATA: 10",
        "UNITS: cm/s^2",
        "STREAM: HNE",
        "HEADER_FORMAT: DYNA 1.2",
        "USER5:",
        *[f"{v:.6f}" for v in VALUES],
    ]


def lvm(
    times: str = "One", decimal: str = ".", separator: str = "Tab", units: str = "cm/s^2"
) -> list[str]:
    """Two channels, the values and their double; times in one column, in none, or in one each."""
    mark = {"Tab": "\t", "Comma": ","}[separator]

    def row(*cells: object) -> str:
        return mark.join(str(cell).replace(".", decimal) for cell in cells)

    head = {"One": ["X_Value", "North", "East"], "No": ["X_Value", "North", "East"],
            "Multi": ["X_Value", "North", "X_Value", "East"]}[times]  # fmt: skip
    rows = []
    for i, value in enumerate(VALUES):
        at = f"{0.01 * i:.6f}"
        cells = {"One": [at, value, 2.0 * value], "No": ["", value, 2.0 * value],
                 "Multi": [at, value, at, 2.0 * value]}[times]  # fmt: skip
        rows.append(row(*cells, "made up" if i == 0 else ""))
    return [
        "LabVIEW Measurement\t",
        row("Writer_Version", 2),
        f"Separator{mark}{separator}",
        f"Decimal_Separator{mark}{decimal}",
        f"X_Columns{mark}{times}",
        f"Time_Pref{mark}Relative",
        "***End_of_Header***" + mark,
        mark,
        row("Channels", 2),
        row("Samples", 10, 10),
        mark.join(["Y_Unit_Label", units, units]),
        mark.join(["X_Dimension", "Time", "Time"]),
        mark.join(["X0", "0", "0"]),
        row("Delta_X", 0.01, 0.01),
        "***End_of_Header***" + mark * 2,
        mark.join([*head, "Comment"]),
        *rows,
    ]
