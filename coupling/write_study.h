#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupling/study.h"
#include "coupling/study_cases.h"

namespace bight::coupling {

/// What a user wants to know: which settings give 5 %, 1 % and 0.3 % in T, and what they cost.
std::vector<std::string> sentences(const Study& plan, const std::vector<StudyRow>& rows,
                                   const StudyCase& of);

/// A row for each run and fidelity; cells that mean nothing are empty.
void write_study_csv(const std::filesystem::path& file, const Study& plan,
                     const std::vector<StudyRow>& rows);

/// A row for each recorded state of each run: T, energy, and how far T is from its reference and
/// from that of the solid of the same problem.
void write_states_csv(const std::filesystem::path& file, const Study& plan,
                      const std::vector<StudyRow>& rows, const std::vector<StudyCase>& cases);

/// The cases: reference, its uncertainty, observed orders, Pareto front, sentences.
void write_study_json(const std::filesystem::path& file, const Study& plan,
                      const std::vector<StudyRow>& rows, const std::vector<StudyCase>& cases);

}  // namespace bight::coupling
