"""Files as people export them: each is read in one call, and all as one and the same table.

Rebounds of a steel ball at six angles, of which one spin was not measured, and one row is blank.
"""

import io
import json
from pathlib import Path

import numpy as np
import openpyxl
import pandas as pd
import pytest
from odf.opendocument import OpenDocumentSpreadsheet
from odf.table import Table, TableCell, TableRow
from odf.text import P

import carom
from carom.cli import main
from carom.io.tables import read_table
from carom.io.user_table import in_units
from carom.lab.fitting.template import TEMPLATE

ANGLES = (5.5, 10.25, 20.0, 35.0, 50.0, 60.5)
SPINS = (-118.25, -210.5, -405.0, None, -471.5, -383.75)  # rpm
SPEED = 0.6
WORDS = {"Winkel": "angle", "Drehzahl": "spin_out", "Geschwindigkeit": "speed"}
NAMES = ("angle", "speed", "spin_out")
BODY = '\nradius = "5 mm"\nmaterial = "steel"\n'
GERMAN = "Winkel [°];Geschwindigkeit [m/s];Drehzahl [U/min];Bemerkung"
ENGLISH = "angle [deg],speed [m/s],spin_out [rpm]"


def german(number):
    return "" if number is None else f"{number}".replace(".", ",")


def lines(head, pattern, gap="", end="\n"):
    """Return a text: a head, and a line for each impact."""
    rows = [
        pattern.format(angle, SPEED, gap if spin is None else spin)
        for angle, spin in zip(ANGLES, SPINS, strict=True)
    ]
    return end.join([head, *rows, ""])


def german_excel():
    """German Excel, "CSV (Trennzeichen-getrennt)": Windows-1252, blank row, blank columns."""
    rows = [
        f"{german(angle)};{german(SPEED)};{german(spin)};{'gut' if spin else ''};"
        for angle, spin in zip(ANGLES, SPINS, strict=True)
    ]
    return "\r\n".join([GERMAN + ";", *rows[:3], ";;;;", *rows[3:], ""]).encode("cp1252")


def german_excel_utf8():
    """German Excel, "CSV UTF-8": with a byte order mark."""
    return german_excel().decode("cp1252").encode("utf-8-sig")


def unicode_text():
    """Excel's "Unicode Text": UTF-16, tabs."""
    return german_excel().decode("cp1252").replace(";", "\t").encode("utf-16")


def libreoffice_csv():
    """LibreOffice: texts in quotes, comma, UTF-8."""
    head = ",".join(f'"{name}"' for name in ENGLISH.split(","))
    return lines(head, "{},{},{}").encode()


def google_sheets():
    """Google Sheets with German settings: commas between, decimal commas in quotes."""
    rows = [
        f'"{german(angle)}","{german(SPEED)}","{german(spin)}",'
        for angle, spin in zip(ANGLES, SPINS, strict=True)
    ]
    return "\r\n".join(["Winkel [°],Geschwindigkeit [m/s],Drehzahl [U/min],", *rows]).encode()


def pandas_csv():
    """A data frame with its index, a date and a text, by to_csv."""
    return frame().to_csv().encode()


def frame():
    """A data frame with NaN, dates and texts beside."""
    return pd.DataFrame(
        {
            "date": pd.Timestamp("2026-11-26"),
            "angle (deg)": ANGLES,
            "speed (m/s)": SPEED,
            "spin_out (rpm)": np.array(SPINS, dtype=float),
            "who": ["Ada", None, "Bo", "Bo", None, "Ada"],
        }
    )


def matlab():
    """MATLAB's writetable below comments with %."""
    return b"% drop test, 26-Nov-2026\n%\n" + lines(ENGLISH, "{},{},{}", "NaN").encode()


def numpy_savetxt():
    """NumPy's savetxt: the names of the columns are in a comment."""
    values = np.array(
        [[a, SPEED, np.nan if s is None else s] for a, s in zip(ANGLES, SPINS, strict=True)]
    )
    file = io.StringIO()
    np.savetxt(file, values, delimiter=",", header=f"by camera\n{ENGLISH}")
    return file.getvalue().encode()


def origin():
    """Origin's ASCII export: tabs; long names, units and comments in rows of their own."""
    head = "angle\tspeed\tspin_out\ndeg\tm/s\trpm"
    return lines(head, "{}\t{}\t{}", end="\r\n").encode()


def phyphox():
    """Phyphox's CSV with semicolons and decimal points: all in quotes."""
    head = '"angle (deg)";"speed (m/s)";"spin_out (rpm)"'
    rows = [
        f"{angle:.9E};{SPEED:.9E};{'NaN' if spin is None else f'{spin:.9E}'}"
        for angle, spin in zip(ANGLES, SPINS, strict=True)
    ]
    return "\n".join([head, *rows]).encode()


def tracker():
    """Tracker's data: the name of the track above the names of the columns."""
    return lines("ball\nangle\tspeed\tspin_out\n°\tm/s\trpm", "{}\t{}\t{}").encode()


def labview():
    """LabVIEW's measurement file, .lvm, with decimal commas, without its comments."""
    rows = [
        f"{german(angle)}\t{german(SPEED)}\t{german(spin) or 'NaN'}"
        for angle, spin in zip(ANGLES, SPINS, strict=True)
    ]
    top = "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t,\n***End_of_Header***\t\n\t\n"
    channels = "Channels\t2\t\t\nSamples\t6\t6\nX0\t0,0\t0,0\n***End_of_Header***\t\t\n"
    head = "Winkel [deg]\tGeschwindigkeit [m/s]\tDrehzahl [U/min]\tComment"
    return "\r\n".join([*(top + channels).splitlines(), head, *rows]).encode()


def table_of_cells():
    """The rows of a sheet, a title above them."""
    yield ["Fallversuche"]
    yield []
    yield GERMAN.split(";")
    for angle, spin in zip(ANGLES, SPINS, strict=True):
        yield [angle, SPEED, spin, "gut"]
        if spin is None:
            yield []


def excel():
    """A workbook with a sheet of notes, a blank one and a hidden one."""
    book = openpyxl.Workbook()
    for row in table_of_cells():
        book.active.append(row)
    book.create_sheet("Notizen")["A1"] = "Kugel aus Stahl"
    book.create_sheet("Tabelle3")
    book.create_sheet("alt").append([1.0, 2.0])
    book["alt"].sheet_state = "hidden"
    return of_book(book)


def of_book(book):
    file = io.BytesIO()
    book.save(file)
    return file.getvalue()


def libreoffice():
    """An .ods of LibreOffice."""
    book = OpenDocumentSpreadsheet()
    sheet = Table(name="Versuch 1")
    for cells in table_of_cells():
        row = TableRow()
        for cell in cells or [None]:
            if isinstance(cell, float):
                row.addElement(TableCell(valuetype="float", value=cell))
            else:
                element = TableCell(valuetype="string")
                element.addElement(P(text=cell or ""))
                row.addElement(element if cell else TableCell())
        sheet.addElement(row)
    book.spreadsheet.addElement(sheet)
    file = io.BytesIO()
    book.write(file)
    return file.getvalue()


FILES = {
    "excel-de.csv": german_excel,
    "excel-de-utf8.csv": german_excel_utf8,
    "excel-unicode.txt": unicode_text,
    "excel.xlsx": excel,
    "libreoffice.ods": libreoffice,
    "libreoffice.csv": libreoffice_csv,
    "google-sheets.csv": google_sheets,
    "pandas.csv": pandas_csv,
    "matlab.csv": matlab,
    "savetxt.csv": numpy_savetxt,
    "origin.dat": origin,
    "phyphox.csv": phyphox,
    "tracker.txt": tracker,
    "labview.lvm": labview,
}


def columns_of(content):
    return WORDS if b"Winkel" in content or content[:2] in (b"PK", b"\xff\xfe") else None


def is_the_table(table):
    """Assert that a table has the numbers of all these files, to the last bit."""
    angles = [carom.quantities.units.number("angle", f"{angle} deg") for angle in ANGLES]
    spins = [
        np.nan if spin is None else carom.quantities.units.number("spin_out", f"{spin} rpm")
        for spin in SPINS
    ]
    assert table["angle"].tolist() == angles
    assert table["speed"].tolist() == [SPEED] * len(ANGLES)
    np.testing.assert_array_equal(table["spin_out"], spins)
    return True


@pytest.mark.parametrize("name", FILES)
def test_files_as_people_export_them_are_read_in_one_call(stored, name):
    content = FILES[name]()
    table = in_units(read_table(stored(content, name), columns_of(content)), NAMES, ("spin_out",))
    assert is_the_table(table)
    (missing,) = table.about_missing()
    assert missing.startswith("1 value missing: spin_out in cell ")


@pytest.mark.parametrize("name", FILES)
def test_files_are_known_by_what_they_hold_and_not_by_their_names(stored, name):
    content = FILES[name]()
    table = in_units(read_table(stored(content, "a"), columns_of(content)), NAMES, ("spin_out",))
    assert is_the_table(table)


def test_a_data_frame_is_read_with_what_else_it_holds():
    table = read_table(frame())
    assert is_the_table(in_units(table, NAMES, ("spin_out",)))
    assert {*table.names} == {"date", *NAMES, "who"}
    with_none = frame().astype({"spin_out (rpm)": object}).replace({np.nan: None})
    assert is_the_table(in_units(read_table(with_none), NAMES, ("spin_out",)))
    assert is_the_table(in_units(read_table(frame().convert_dtypes()), NAMES, ("spin_out",)))


@pytest.mark.slow
def test_the_empty_table_may_be_stored_as_a_workbook(tmp_path):
    """Filled in there it gives the fit of the same numbers as CSV, with its units and bodies."""
    lines = TEMPLATE.splitlines()
    values = zip(ANGLES, SPINS, strict=True)
    rows = [[angle, SPEED, 0.95, None, spin] for angle, spin in values if spin is not None]
    texts = [",".join("-" if cell is None else str(cell) for cell in row) for row in rows]
    (tmp_path / "filled.csv").write_text("\n".join([*lines, *texts]), encoding="utf-8")
    book = openpyxl.Workbook()
    for row in [*([line] for line in lines[:-1]), lines[-1].split(","), *rows]:
        book.active.append(row)
    book.save(tmp_path / "filled.xlsx")
    csv, excel = (carom.fit(tmp_path / f"filled.{end}").to_dict() for end in ("csv", "xlsx"))
    assert csv["parameters"] == excel["parameters"]
    table = read_table(tmp_path / "filled.xlsx")
    assert table.case["first"] == {"radius": "10 mm", "material": "steel"}
    assert table.rows[0] == len(lines) + 1


@pytest.mark.slow
def test_commands_read_files_in_one_way_and_store_it(tmp_path, capsys, monkeypatch):
    """Columns, sheet and decimal sign by options, by what they stored, and by a case file."""
    monkeypatch.chdir(tmp_path)
    book = openpyxl.Workbook()
    for name, factor in (("Alt", 2.0), ("Neu", 1.0)):
        sheet = book.create_sheet(name)
        sheet.append(["Winkel [°]", "v_in", "Drehzahl [1/min]", "n", "m", "l"])
        for angle, spin in zip(ANGLES, SPINS, strict=True):
            sheet.append([angle, factor * SPEED, spin, 0.3, 0.0, 0.5])
    book.save("lab.xlsx")
    Path("case.toml").write_text("friction = 0.2\n[first]" + BODY)
    options = ["--column", "v_in=speed", "--column", "Winkel=angle"]
    options += ["--column", "Drehzahl [1/min]=spin_out [rpm]"]
    how = [*options, "--sheet", "Neu", "--save-columns", "map.toml"]
    fit = ["fit", "--case", "case.toml", "--fix", "restitution=1", "--json"]
    assert main([*fit, "lab.xlsx", *how]) == 0
    first = json.loads(capsys.readouterr().out)
    assert main([*fit, "lab.xlsx", "--columns", "map.toml"]) == 0
    assert json.loads(capsys.readouterr().out) == first
    assert main([*fit, "lab.xlsx:Neu", *options]) == 0
    assert json.loads(capsys.readouterr().out) == first
    assert main([*fit, "lab.xlsx", *options]) == 2
    said = "its sheets 'Alt', 'Neu' may be meant; say which, by lab.xlsx:Alt or --sheet\n"
    assert capsys.readouterr().err.endswith(said)
    columns = 'columns = {"Winkel" = "angle", "v_in" = "speed"}\nsheet = "Alt"\n'
    table = '[sweep]\ntable = "two.xlsx"\n' + columns
    for sheet in book:
        sheet.delete_cols(3, 4)
    book.save("two.xlsx")
    Path("sweep.toml").write_text("friction = 0.2\n[first]" + BODY + table, encoding="utf-8")
    for sheet, speed in ([], 1.2), (["--sheet", "Neu"], 0.6):
        assert main(["sweep", "sweep.toml", "--json", "--output", "out.nc", *sheet]) == 0
        with carom.read("out.nc") as stored:
            assert stored["speed"].values.tolist() == [speed] * len(ANGLES)
