"""The notebooks: run anew with their outputs kept, and shown as pages of the book.

    python scripts/book/notebooks.py        runs all of notebooks/ and writes their outputs into them

That needs the package saltus, matplotlib, pandas, nbclient and ipykernel; to show them nothing is needed.
"""

import base64
import json
import sys
from pathlib import Path

NOTEBOOKS = Path(__file__).resolve().parent.parent.parent / "notebooks"
# A notebook takes some 30 s of processor time.
SECONDS = 600


def execute(path: Path):
    """The notebook with the outputs of its code, run in order; raises the exception of the first cell that fails."""
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(path, as_version=4)
    NotebookClient(notebook, timeout=SECONDS, resources={"metadata": {"path": str(path.parent)}}).execute()
    for cell in notebook.cells:
        # parts that differ in each run and mean nothing: times, and bars of progress
        cell.metadata.pop("execution", None)
        if cell.cell_type == "code":
            cell.outputs = [output for output in cell.outputs if output.get("name") != "stderr"]
    notebook.metadata["language_info"] = {"name": "python"}
    return notebook


def page(path: Path, place: Path):
    """Writes a notebook with its outputs as the page `place`, and its pictures beside it."""
    text, pictures = [], 0
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            text.append(source.replace(".ipynb)", ".md)"))
            continue
        text.append(f"```python,no-run\n{source}\n```")
        for output in cell["outputs"]:
            data = output.get("data", {})
            if "image/png" in data:
                pictures += 1
                name = f"{place.stem}-{pictures}.png"
                (place.parent / name).write_bytes(base64.b64decode("".join(data["image/png"])))
                text.append(f"![Output of the code above]({name})")
            elif "text/html" in data and "<table" in "".join(data["text/html"]):
                text.append(_table("".join(data["text/html"])))
            elif shown := "".join(data.get("text/plain", output.get("text", ""))):
                text.append(f"```text\n{shown.rstrip()}\n```")
    place.write_text("\n\n".join(text) + "\n", encoding="utf-8")


def _table(html: str) -> str:
    """The table alone, without the blank lines and styles around it, which would end it in Markdown."""
    body = html[html.index("<table") : html.index("</table>") + len("</table>")].replace('border="1" ', "")
    return "\n".join(line for line in body.splitlines() if line.strip())


def main():
    import nbformat

    for path in sorted(NOTEBOOKS.glob("*.ipynb")):
        nbformat.write(execute(path), path)
        print(path.name, f"{path.stat().st_size / 1e6:.2f} MB", file=sys.stderr)


if __name__ == "__main__":
    main()
