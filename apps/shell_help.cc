// Help texts and messages about a wrong command line.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "ident/core/nearest_word.h"
#include "shell.h"

namespace ident::app {
namespace {

constexpr std::size_t kWidth = 80;   // columns of a terminal
constexpr std::size_t kColumn = 26;  // where the meaning of an option begins

/// Where the lines that continue a line begin: under the second column if it has one, else a little further
/// in.
std::size_t indent_of(const std::string& line) {
  const std::size_t first = line.find_first_not_of(' '), gap = line.find("  ", first);
  if (gap < kColumn) return line.find_first_not_of(' ', gap);
  const bool option = first == 2 && line.size() > kColumn && line[kColumn - 1] == ' ' && line[first] == '-';
  return option ? kColumn : first == 0 ? 0 : std::min(first + 4, kColumn);
}

/// Breaks lines that are too long at blanks.
std::string within(std::size_t width, const std::string& text) {
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t indent = indent_of(line);
    while (line.size() > width) {
      const std::size_t at = line.rfind(' ', width);
      if (at == std::string::npos || at <= indent) break;
      out += line.substr(0, at) + "\n";
      line = std::string(indent, ' ') + line.substr(at + 1);
    }
    out += line + "\n";
  }
  return out;
}

class HelpLayout : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* cli, std::string name, CLI::AppFormatMode mode) const override {
    if (mode == CLI::AppFormatMode::Sub) return make_expanded(cli);
    return within(kWidth, make_description(cli) + make_footer(cli) + "\n" + make_usage(cli, name) +
                              make_positionals(cli) + make_groups(cli, mode) + make_subcommands(cli, mode));
  }
};

std::vector<std::string> subcommand_names(const CLI::App& cli) {
  std::vector<std::string> names;
  for (const CLI::App* sub : cli.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& cli) {
  std::vector<std::string> names;
  for (const CLI::Option* option : cli.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The subcommand that was being parsed, or the program itself.
const CLI::App& innermost(const CLI::App& cli) {
  const auto parsed = cli.get_subcommands();
  return parsed.empty() ? cli : innermost(*parsed.front());
}

std::string full_name(const CLI::App& cli) {
  return cli.get_parent() ? full_name(*cli.get_parent()) + " " + cli.get_name() : cli.get_name();
}

std::string about_unknown(const CLI::App& cli, const std::string& word) {
  if (word.starts_with("-")) {
    const std::string name = word.substr(0, word.find('='));
    return fmt::format("unknown option {}{}", name, did_you_mean(name, option_names(cli)));
  }
  const std::vector<std::string> names = subcommand_names(cli);
  if (names.empty()) return fmt::format("'{}' is one argument too many", word);
  return fmt::format("unknown command '{}'{}", word, did_you_mean(word, names));
}

}  // namespace

std::shared_ptr<CLI::FormatterBase> help_layout() {
  auto layout = std::make_shared<HelpLayout>();
  layout->label("Positionals", "Arguments");
  layout->label("SUBCOMMAND", "COMMAND");
  layout->label("Subcommands", "Commands");
  layout->column_width(kColumn);
  return layout;
}

void examples(CLI::App& cli, const std::vector<Example>& list) {
  std::string text = "\nExamples:";
  for (const Example& example : list)
    text += fmt::format("\n  {}\n      {}", example.command, example.meaning);
  cli.footer(text);
}

std::string usage_message(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& cli = innermost(program);
  const std::vector<std::string> unknown = cli.remaining();
  const std::string what = unknown.empty() ? error.what() : about_unknown(cli, unknown.front());
  return fmt::format("{}\nTry '{} --help'.", what, full_name(cli));
}

}  // namespace ident::app
