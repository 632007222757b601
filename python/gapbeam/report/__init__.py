"""Results as text, for people and for programs."""

from .json_csv import data_as_json, to_csv, to_json
from .text import print_report, report_text

__all__ = ["data_as_json", "print_report", "report_text", "to_csv", "to_json"]
