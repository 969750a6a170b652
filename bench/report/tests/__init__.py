"""Tests of the report. From the root: python3 -m unittest discover -s bench/report/tests -t bench."""
