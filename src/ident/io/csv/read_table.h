// A CSV of any dialect as a table in SI units.
#pragma once

#include <string>
#include <vector>

#include "ident/data/table.h"
#include "ident/io/csv/units.h"

namespace ident {

/// A spelling of a signal in a header, with the unit that holds where the header names none.
struct Alias {
  std::string header;
  std::string unit;
};

/// A signal that a file may hold. Headers are compared without case, blanks and underscores alike. Where
/// several spellings stand in a file, the name itself wins, then the first alias.
struct Signal {
  std::string name;  ///< canonical, itself an accepted header, SI where the header names no unit
  Dimension dimension = Dimension::number;
  std::vector<Alias> aliases;
  double largest =
      0.0;  ///< magnitude (SI) that 9 of 10 samples keep below, else the unit is wrong; 0: no limit
};

/// A column of words.
struct TextSignal {
  std::string name;
  std::vector<std::string> words;  ///< what may stand there
};

/// What a kind of file holds. `required`: for each entry at least one alternative, all of whose columns are
/// there.
struct TableSchema {
  std::string kind;  ///< "thrust sweep", for messages
  std::vector<Signal> signals;
  std::vector<TextSignal> text;
  std::vector<std::vector<std::vector<std::string>>> required;
  bool time_ordered = false;  ///< `t` has to run forward: rows that go back are dropped with a warning
  bool propeller_coefficients = false;  ///< files with RPM, CT and CP (UIUC) are understood
};

/// t, delta | u (pulse width in us), omega | omega_electrical | omega_optical; voltage.
/// axis (text: x, y, z, platform), period | time and oscillations, mass, radius, length; offset, amplitude,

struct TableMap;

struct TableOptions {
  std::string names;              ///< the header of a file that has none, with commas
  const TableMap* map = nullptr;  ///< columns under other names
};

/// Reads a table. Columns that the file does not have, or that are empty throughout, are absent from the
/// result. Throws InputError (not readable, a required column missing, an implausible unit) or DataError (a
/// required column without any usable value).
NumberTable read_table(const std::string& path, const TableSchema& schema, const TableOptions& options = {});

}  // namespace ident
