// `ident init` on the files of the sample campaign, and the commands that then work with no file named.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "ident/result/result.h"
#include "support/run_program.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

/// The sample's files without its ident.yaml.
std::string sample_files() {
  const fs::path folder = fs::path(test_folder()) / "files";
  fs::remove_all(folder);
  fs::copy(fs::path(IDENT_SOURCE_DIR) / "data/sample", folder, fs::copy_options::recursive);
  fs::remove(folder / "ident.yaml");
  return folder.string();
}

TEST(Init, LaysOutTheSampleSoThatCommandsNeedNoFile) {
  const std::string folder = sample_files();
  const ProgramRun init = run_ident({"init", folder, "--json"});
  ASSERT_EQ(init.status, 0) << init.err;
  const auto json = nlohmann::json::parse(init.out);
  EXPECT_EQ(json["command"], "init");
  EXPECT_EQ(json["vehicle"]["file"], "falcon.yaml");
  EXPECT_EQ(json["taken"].size(), 6U);
  EXPECT_TRUE(json["left"].empty());
  EXPECT_EQ(json["next"]["now"].size(), 6U);
  for (const char* command : {"thrust", "motor", "inertia", "check"}) {
    const ProgramRun run = run_ident({command}, folder);
    EXPECT_EQ(run.status, 0) << command << ": " << run.err;
  }
}

TEST(Init, TellsWhatItTookAndWhatToDoNext) {
  const std::string folder = sample_files();
  write_text(folder, "notes.txt", "Flown at noon.\n");
  const ProgramRun init = run_ident({"init"}, folder);
  ASSERT_EQ(init.status, 0) << init.err;
  for (const char* part : {"thrust_sweep.csv  thrust sweep", "flight_eight.csv  flight log",
                           "Left alone:", "notes.txt", "these work now: ident thrust, ident motor"})
    EXPECT_NE(init.out.find(part), std::string::npos) << part << "\n" << init.out;
}

TEST(Init, OverwritesNothing) {
  const std::string folder = sample_files();
  ASSERT_EQ(run_ident({"init"}, folder).status, 0);
  const ProgramRun again = run_ident({"init"}, folder);
  EXPECT_EQ(again.status, 2);
  EXPECT_TRUE(again.out.empty());
  EXPECT_NE(again.err.find("ident.yaml: is there already"), std::string::npos) << again.err;
  fs::remove(fs::path(folder) / "ident.yaml");
  fs::remove(fs::path(folder) / "falcon.yaml");
  write_text(folder, "vehicle.yaml", "rotors: none\n");
  const ProgramRun broken = run_ident({"init"}, folder);
  EXPECT_EQ(broken.status, 2);
  EXPECT_NE(broken.err.find("vehicle.yaml"), std::string::npos) << broken.err;
  EXPECT_FALSE(fs::exists(fs::path(folder) / "ident.yaml"));
}

}  // namespace
}  // namespace ident
