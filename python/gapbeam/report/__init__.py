"""Results as text, for people and for programs."""

from .json_csv import to_csv, to_json
from .text import print_report, report_text

__all__ = ["print_report", "report_text", "to_csv", "to_json"]
