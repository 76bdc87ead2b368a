#include "hovercraft_sim/report/report.h"

#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/io/progress_bar.h"
#include "hovercraft_sim/report/page.h"
#include "hovercraft_sim/report/recorded_topics.h"
#include "hovercraft_sim/report/run_figures.h"
#include "hovercraft_sim/report/run_reader.h"

namespace hovercraft_ros {
namespace {

RunData readRun(const std::string& path, bool shows_progress, std::ostream& terminal) {
  std::optional<hovercraft::ProgressBar> bar;
  const auto progress = [&](std::int64_t done, std::int64_t whole) {
    if (!bar) bar.emplace(terminal, whole);
    bar->show(done);
  };
  return runDataOf(readTopics(path, shows_progress ? ReadingProgress(progress) : nullptr));
}

/// A text of a bag, for a terminal: without what would move its cursor.
std::string plain(std::string text) {
  for (char& character : text) {
    const auto code = static_cast<unsigned char>(character);
    if (code < 0x20 || code == 0x7f) character = '?';
  }
  return text;
}

void writeFile(const std::string& path, const std::string& content) {
  hovercraft::OutputFile file(path);
  file.write(content.data(), content.size());
  file.close();
}

/// The folder that is asked for is there then. @throws std::invalid_argument if it cannot be.
void makeFolder(const std::string& option, const std::string& path) {
  if (path.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!std::filesystem::is_directory(path)) {
    throw std::invalid_argument(fmt::format("{} = {}: must be a folder, or a name that is free{}",
                                            option, path,
                                            error ? " (" + error.message() + ")" : ""));
  }
}

/// Each figure as a file of its own. No file of a folder may be one that is read, or another one.
void writeFigures(const std::string& option, const std::string& folder,
                  const std::vector<NamedFigure>& figures, const std::vector<std::string>& inputs,
                  const std::function<std::string(const Figure&)>& format) {
  if (folder.empty()) return;
  std::vector<hovercraft::OutputOption> files;
  for (const NamedFigure& named : figures) {
    const std::string name = named.name + "." + option.substr(2);
    files.push_back({option, (std::filesystem::path(folder) / name).string()});
  }
  hovercraft::checkOutputs(files, inputs);
  auto file = files.cbegin();
  for (const NamedFigure& named : figures) writeFile((file++)->path, format(named.figure));
}

}  // namespace

std::string makeReport(const ReportRequest& request, std::ostream& terminal) {
  std::vector<std::string> inputs = {request.bag};
  if (!request.other.empty()) inputs.push_back(request.other);
  hovercraft::checkOutputs({{"--output", request.output}}, inputs);
  if (request.output != "-" && std::filesystem::path(request.output).extension() != ".html") {
    throw std::invalid_argument(fmt::format(
        "--output = {}: must end in .html, or be - for the standard output", request.output));
  }
  makeFolder("--png", request.png);
  makeFolder("--svg", request.svg);
  std::vector<RunData> runs;
  for (const std::string& path : inputs) {
    runs.push_back(readRun(path, request.shows_progress, terminal));
    for (const std::string& note : runs.back().notes)
      terminal << path << ": " << plain(note) << '\n';
  }
  const auto comparisons =
      runs.size() > 1 ? compareRuns(runs[0], runs[1]) : std::vector<BodyComparison>();
  const std::string page = pageOf(runs, comparisons);
  writeFile(request.output, page);
  const bool wants_figures = !request.png.empty() || !request.svg.empty();
  const auto figures = wants_figures ? figuresOf(runs) : std::vector<NamedFigure>();
  inputs.push_back(request.output);  // it must stay, as what was read
  writeFigures("--png", request.png, figures, inputs, pngOf);
  writeFigures("--svg", request.svg, figures, inputs, svgOf);
  std::string summary;
  for (const RunData& run : runs) {
    if (runs.size() > 1) summary += run.source + '\n';
    for (const RunFact& fact : run.facts) {
      summary += fmt::format("{:<34}  {}\n", plain(fact.label), plain(fact.value));
    }
  }
  return summary + fmt::format("{:<34}  {} ({:.1f} MB, needs no network)", "page", request.output,
                               1e-6 * static_cast<double>(page.size()));
}

}  // namespace hovercraft_ros
