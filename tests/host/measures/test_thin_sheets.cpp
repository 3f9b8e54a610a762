// What a run tells of fluid in thin sheets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/measures/thin_sheets.hpp"
#include "host/run/run.hpp"
#include "host/temp_folder.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing_tools::read_text_file;
using testing_tools::TempFolder;
using testing_tools::tiny_case;

Totals with(std::int64_t in_sheets) {
  Totals totals;
  totals.in_thin_sheets = in_sheets;
  return totals;
}

TEST(ThinSheets, TellsTheMostAndWhen) {
  const Case c = parse_case(tiny_case(), "tiny.toml");
  ThinSheets sheets;
  EXPECT_THAT(sheets.lines(c, 200), IsEmpty());
  sheets.look(with(3), 0.1), sheets.look(with(7), 0.25), sheets.look(with(2), 0.5);
  EXPECT_THAT(
      sheets.lines(c, 200),
      testing::ElementsAre("in sheets thinner than three spacings (0.006 m): 7 particles (3.5 %) at most, "
                           "at 0.25 s; 2 at the end"));
  EXPECT_THAT(sheets.warnings(c, 200), IsEmpty());
  EXPECT_THAT(sheets.warnings(c, 100), Contains(HasSubstr("resolution.spacing = 0.001 m")));
  ThinSheets resumed;
  resumed.restore(sheets.most(), sheets.time_of_most());
  resumed.look(with(2), 0.5);
  EXPECT_EQ(resumed.lines(c, 200), sheets.lines(c, 200));
}

// The tiny case's block is five spacings high; two of them make a sheet of it.
TEST(ThinSheets, OfARunAreInItsHistoryItsSummaryAndItsResults) {
  const TempFolder folder;
  RunOptions options;
  options.folder = folder / "run", options.verbosity = Verbosity::quiet, options.threads = 1;
  const RunOutcome thick = run_case(parse_case(tiny_case(), "tiny.toml"), options);
  EXPECT_THAT(read_text_file(folder / "run/summary.json"), HasSubstr("\"in_thin_sheets\": {\n"));
  EXPECT_THAT(thick.results, testing::Not(Contains(HasSubstr("in sheets thinner"))));
  options.folder = folder / "sheet";
  const std::string sheet = "region.0.shapes=[{shape=\"box\", min=[0, 0, 0], max=[0.01, 0.01, 0.004]}]";
  const RunOutcome thin = run_case(parse_case(tiny_case(), "tiny.toml", {sheet}), options);
  EXPECT_THAT(thin.results,
              Contains(HasSubstr("in sheets thinner than three spacings (0.006 m): 50 particles "
                                 "(100 %) at most")));
  EXPECT_THAT(read_text_file(folder / "sheet/history.csv"), HasSubstr(",in_thin_sheets,"));
  EXPECT_THAT(read_text_file(folder / "sheet/log.txt"), HasSubstr("tear by themselves"));
}

}  // namespace
}  // namespace slagflow
