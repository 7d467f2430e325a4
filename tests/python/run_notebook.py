"""Executes a notebook in an empty folder; fails where a cell fails or draws nothing. Usage: run_notebook.py FILE"""

import os
import sys

import nbformat
from nbclient import NotebookClient

notebook = nbformat.read(sys.argv[1], as_version=4)
os.environ["PLUMBLINE_ROOT"] = os.getcwd()
NotebookClient(notebook, timeout=300, kernel_name="python3",
               resources={"metadata": {"path": os.path.dirname(sys.argv[1])}}).execute()
outputs = [o for cell in notebook.cells if cell.cell_type == "code" for o in cell.outputs]
pictures = sum("image/png" in o.get("data", {}) for o in outputs)
said = "\n".join(o.get("text", "") + o.get("data", {}).get("text/plain", "") for o in outputs)
if pictures < 2 or "cable_stretch" not in said:
    sys.exit(f"{pictures} pictures, and the effect's name is {'' if 'cable_stretch' in said else 'not '}in the text")
print(f"{len(outputs)} outputs, {pictures} pictures")
