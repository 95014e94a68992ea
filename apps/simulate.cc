// `ident simulate`: flights and bench data of any vehicle file, with known truth.
#include "simulate.h"

namespace ident::app {

Action simulate_command(CLI::App& cli) {
  auto chosen = std::make_shared<Action>();
  cli.require_subcommand(1);
  add_simulate_flight(cli, chosen);
  examples(cli,
           {{"ident simulate flight --vehicle falcon.yaml --output flight.csv", "a mixed flight of 60 s"},
            {"ident simulate thrust --vehicle falcon.yaml --output sweep.csv", "a thrust sweep"}});
  return [chosen](Context& context) { return (*chosen)(context); };
}

}  // namespace ident::app
