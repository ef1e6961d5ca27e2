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
        "Max. Acc. (gal)   3331.25",
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


UNEVEN = [0.0, 0.004, 0.013, 0.021, 0.03, 0.04, 0.049, 0.062, 0.07, 0.081]
"""Times of digitised film in s."""
EVEN = [0.01 * i for i in range(len(VALUES))]


def csmip_pairs(
    times: Sequence[float] = UNEVEN,
    count: str = "10",
    peak: str = "-.350 G",
    unit: str = "G/10",
    lasts: str = ".081",
    agency: str = "CDMG",
) -> list[str]:
    """Times and values in turn, as in the 1990s; also RENADIC's files."""
    numbers = [f"{x:7.3f}" for pair in zip(times, VALUES, strict=True) for x in pair]
    integers = lines_of([f"{n:5d}" for n in [1] * 100], 16)
    return [
        "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 01/02/94, MADE UP",
        "MADE UP",
        "JANUARY 2, 1994 03:04 PST",
        "00001-S0001-94002.01",
        "STATION NO. 00001   33.634N, 117.902W     SMA-1  S/N 1690",
        "NOWHERE - MAIN STREET",
        "CHAN  1:  45 DEG",
        agency,
        "HYPOCENTER: 34.201N,116.826W, H=7KM.",
        "INSTR PERIOD =  .0388 SEC,  DAMPING =  .561,  SENSITIVITY = 1.77 CM/G.",
        f"NO. OF POINTS =  {count}  RECORD LENGTH = {lasts} SEC",
        f"UNITS OF UNCOR ACCEL ARE SEC AND {unit}.     MAX  =  {peak}, AT  .021 SEC.",
        "RMS ACCEL OF COMPLETE RECORD =  .006 G.",
        *integers,
        *lines_of([f"{x:10.3f}" for x in [0.0] * 50], 8),
        *lines_of(numbers, 10),
        "/&  ----------  END OF DATA FOR CHANNEL  1  ----------",
    ]


def renadic(count: str = "10", peak: str = "-0.350 G", lasts: str = "0.100") -> list[str]:
    lines = csmip_pairs(EVEN, count, peak, lasts=lasts, agency="UNIVERSIDAD DE CHILE - RENADIC")
    lines[4] = "STATION NO.          0.000N    0.000E  QDR       S/N  672 (3  CHNS OF 3  AT STA)"
    lines[6] = "CHAN  1: EW       (STA CHN:  1)"
    return lines


def cosmos_counts(
    size: str = "0.500000", sensitivity: str = "2.000000", gain: str = "1.000000"
) -> list[str]:
    """V0: counts of half a µV, of an accelerometer with 2 V/g."""
    lines = cosmos(unit="counts(50)")
    lines[0] = "Raw acceleration counts   (Format v01.20 with 13 text lines)"
    first = next(at for at, line in enumerate(lines) if "Real-header" in line) + 1
    reals = ["  -999.000000"] * 100
    stated = {21: size, 41: sensitivity, 46: gain, 61: "10.000000", 62: "0.100000", 63: "14000000."}
    for at, text in stated.items():
        reals[at] = f"{text:>13}"
    lines[first : first + 17] = lines_of(reals, 6)
    lines[first - 11] = lines[first - 11].replace("    -999    -999", "       0       1", 1)
    above = next(at for at, line in enumerate(lines) if "pts, approx" in line)
    lines[above] = "   10 raw accel.   pts, approx   0 secs, units= counts(50),Format=(8I10)"
    counts = [f"{round(4e6 * v):10d}" for v in VALUES]
    return [*lines[: above + 1], *lines_of(counts, 8), "End-of-data for Chan  1 acceleration"]


def short(number: float) -> str:
    """A number in ten characters, as SMC files write it."""
    return f"{number:10.4E}".replace("E+0", "E+").replace("E-0", "E-").rjust(10)


def smc_pairs(
    times: Sequence[float] = UNEVEN,
    rate: str = "  0.1700000E+39",
    least: str = " -0.3500000E+01",
    count: int = 20,
) -> list[str]:
    """Times and values in turn, as of digitised film."""
    lines = smc()
    lines[0] = "1 UNCORRECTED ACCELEROGRAM"
    lines[13] = f"{count:10d}" + lines[13][10:]
    reals = ["  0.1700000E+39"] * 50
    reals[1], reals[28:32] = rate, ["  0.1300000E-01", "  0.2000000E+01", "  0.2100000E-01", least]
    lines[17:27] = lines_of(reals, 5)
    numbers = [short(x) for pair in zip(times, VALUES, strict=True) for x in pair]
    return [*lines[:28], *lines_of(numbers, 8)]


def knet_csv(
    components: str = "N-S(gal),E-W(gal),U-D(gal)", rate: str = "100", lasts: str = "0.1"
) -> list[str]:
    columns = components.count(",") + 1
    rows = [
        f"2003/01/02 03:04:15.{n:02d},{0.01 * n:.2f},"
        + ",".join(f"{v * (k + 1):.4f}" for k in range(columns))
        for n, v in enumerate(VALUES)
    ]
    return [
        "#K-NET CSV",
        "#Event",
        "#OriginTime,Latitude,Longitude,Depth(km),Magnitude",
        "#2003/01/02 03:04:05,41.010,142.447,34,6.3",
        "#Station",
        "#Code,Latitude,Longitude,Height(m)",
        "#NWH001,41.5267,140.9244,19",
        "#Record",
        "#SamplingFrequency(Hz)",
        f"#{rate}",
        "#DurationTime(s)",
        f"#{lasts}",
        "#Offset",
        f"#{components}",
        "#" + ",".join(["0.00"] * columns),
        f"#Time,RelativeTime(s),{components}",
        *rows,
    ]


def cwb(
    rate: str = "100", lasts: str = "0.1", most: str = "2.000~   -3.500", unit: str = "gal."
) -> list[str]:
    return [
        "#Earthquake Information",
        "#Origin Time(GMT+08): 2003/01/02-03:04:05",
        "",
        "#Station Information",
        "#StationCode: NWH",
        "#InstrumentKind: FBA",
        f"#RecordLength(sec): {lasts}",
        f"#SampleRate(Hz): {rate}",
        f"#AmplitudeUnit:  {unit} DCoffset(corr)",
        f"#AmplitudeMAX. U:    {most}",
        "#AmplitudeMAX. N:    4.000~   -7.000",
        "#AmplitudeMAX. E:    6.000~  -10.500",
        "#DataSequence: Time U(+); N(+); E(+)",
        "#Data: 4F10.3 ",
        *[
            "".join(f"{x:10.4f}" for x in (0.01 * n, v, 2.0 * v, 3.0 * v))
            for n, v in enumerate(VALUES)
        ],
    ]


def nsmn(
    count: str = "10", peak: str = "3.500000", step: str = "0.01", unit: str = "(gal)"
) -> list[str]:
    return [
        "STRONG GROUND MOTION RECORDS OF TURKIYE",
        "PLACE                   : NOWHERE",
        "EARTHQUAKE DATE         : 2003/01/02 03:04:05 (GMT)",
        "STATION ID              : 0001",
        f"NUMBER OF DATA          : {count}",
        f"SAMPLING INTERVAL (sec) : {step}",
        f"RAW PGA VALUES {unit}    : (N-S) {peak} (E-W) 7.000000 (U-D) 10.500000",
        "       N-S          E-W          U-D",
        *[f"{v:12.6f}{2.0 * v:14.6f}{3.0 * v:14.6f}" for v in VALUES],
    ]


def csmnc(
    count: str = "10",
    peak: str = "-3.500",
    step: str = "0.010",
    lasts: str = "0.10",
    unit: str = "CM/SEC/SEC",
) -> list[str]:
    return [
        "00NWH030102030405",
        "0030102030405 2003-01-02 3:4:5 BTM",
        "STATION: 00NWH 30.400N 102.800E",
        "COMP. EW",
        f"UNCORRECTED ACCELERATION          UNIT: {unit}",
        f"NO. OF POINTS:  {count}  EQUALLY SPACED INTERVALS OF:  {step}  SEC",
        f"PEAK VALUE:    {peak}   AT   0.03 SEC    DURATION:  {lasts} SEC",
        "PRE-EVENT TIME:  0  SEC",
        "CSMNC",
        "",
        *lines_of([f"{v:13.6E} " for v in VALUES], 8),
    ]


def unam(
    count: str = "10",
    peak: str = "-3.5000",
    step: str = "0.01",
    rate: str = "100",
    lasts: str = "0.10",
    unit: str = "Gal (cm/s/s)",
) -> list[str]:
    return [
        "*" * 80,
        "ARCHIVO ESTANDAR DE ACELERACION:",
        "VERSION DEL FORMATO                    : 2.0",
        "CLAVE DE LA ESTACION                   : NWHR",
        f"VEL. DE MUESTREO, C1-C6 (muestras/s)   : /{rate}/{rate}/{rate}",
        "VEL. DE MUESTREO, C7-C12 (muestras/s)  : ",
        f"INTERVALO DE MUESTREO, C1-C6 (s)       : /{step}/{step}/{step}",
        f"DURACION DEL REGISTRO (s), C1-C6       : /{lasts}/{lasts}/{lasts}  ",
        f"NUM. TOTAL DE MUESTRAS, C1-C6          : /{count}/{count}/{count}  ",
        "NUM. TOTAL DE MUESTRAS, C7-C12         : ",
        f"ACEL. MAX.(Gal), C1-C6                 : /{peak}/-7.0000/-10.5000",
        "ACEL. MAX., C1-C6, EN LA MUESTRA       : /4/4/4",
        f"UNIDADES DE LOS DATOS                  : {unit}",
        "FORMATO DATOS (FORTRAN,10 campos/dato) : 3F10.4",
        "DATOS DE ACELERACION:",
        "---------+---------+---------+---------+",
        "   CANAL-1   CANAL-2   CANAL-3",
        "         V      N00E      N90E",
        "---------+---------+---------+---------+",
        *[f"{v:10.4f}{2.0 * v:10.4f}{3.0 * v:10.4f}" for v in VALUES],
    ]
