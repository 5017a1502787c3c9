"""All cases, kind by kind."""

import cases_results
import cases_scripts
import cases_studies
import cases_tables
import cases_text
import cases_values
import cases_words


def cases(fixtures):
    for part in (cases_words, cases_text, cases_values, cases_tables, cases_results, cases_studies, cases_scripts):
        yield from part.cases(fixtures)
