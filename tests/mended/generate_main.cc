// Draws the cases of the campaign on mended simulator files.
#include <iostream>

#include "mended_case.h"
#include "options.h"

int main(int argc, char** argv) {
  try {
    const mended::CommandLine options(argc, argv,
                                      {{"--seed", "1"}, {"--cases", "40"}, {"--first", "1"}, {"--out", ""}});
    const auto seed = static_cast<std::uint64_t>(std::stoull(options.text("--seed")));
    const int first = options.integer("--first");
    for (int index = first; index < first + options.integer("--cases"); ++index) {
      const mended::Case drawn = mended::draw_case(seed, index);
      mended::write_case(drawn, index, seed, options.required("--out"));
      std::cerr << index << ' ' << drawn.target << " attempts " << drawn.attempts;
      for (const auto& p : drawn.present) std::cerr << ' ' << p.member.name << ' ' << p.size;
      std::cerr << '\n';
    }
    return 0;
  } catch (const std::invalid_argument& error) {
    std::cerr << "mended_generate: " << error.what()
              << "\nmended_generate --out DIR [--seed S] [--cases N] [--first I]\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "mended_generate: " << error.what() << '\n';
    return 1;
  }
}
