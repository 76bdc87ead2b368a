#include "hovercraft_sim/report/report.h"

#include <fmt/format.h>
#include <optional>
#include <vector>

#include "hovercraft_sim/report/page.h"
#include "hovercraft_sim/report/recorded_topics.h"
#include "hovercraft_sim/report/run_reader.h"
#include "hovercraft_sim/ros/progress_bar.h"
#include "hovercraft_sim/sim/output_file.h"

namespace hovercraft_ros {
namespace {

RunData readRun(const std::string& path, bool shows_progress, std::ostream& terminal) {
  std::optional<ProgressBar> bar;
  const auto progress = [&](std::int64_t done, std::int64_t whole) {
    if (!bar) bar.emplace(terminal, whole);
    bar->show(done);
  };
  return runDataOf(readTopics(path, shows_progress ? ReadingProgress(progress) : nullptr));
}

}  // namespace

std::string makeReport(const ReportRequest& request, std::ostream& terminal) {
  std::vector<std::string> inputs = {request.bag};
  if (!request.other.empty()) inputs.push_back(request.other);
  hovercraft::checkOutputs({{"--output", request.output}}, inputs);
  std::vector<RunData> runs;
  for (const std::string& path : inputs) {
    runs.push_back(readRun(path, request.shows_progress, terminal));
    for (const std::string& note : runs.back().notes) terminal << path << ": " << note << '\n';
  }
  const auto comparisons =
      runs.size() > 1 ? compareRuns(runs[0], runs[1]) : std::vector<BodyComparison>();
  const std::string page = pageOf(runs, comparisons);
  hovercraft::OutputFile file(request.output);
  file.write(page.data(), page.size());
  file.close();
  return fmt::format("{}: {:.1f} MB; open it in a browser, it needs no network", request.output,
                     1e-6 * static_cast<double>(page.size()));
}

}  // namespace hovercraft_ros
