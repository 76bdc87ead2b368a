#include "hovercraft_sim/sim/output_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>

namespace hovercraft {

namespace fs = std::filesystem;

PartialFile::PartialFile(const std::string& path) : path_(path), partial_path_(path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    partial_path_ = path + ".partial";
  } else if (fs::is_regular_file(path, ignored)) {
    path_ = fs::canonical(path).string();  // behind a link, so that the link stays one
    partial_path_ = path_ + ".partial";
  }
}

void PartialFile::commit() const {
  if (partial_path_ == path_) return;
  std::error_code error;
  fs::rename(partial_path_, path_, error);
  if (!error) return;
  throw std::invalid_argument(
      fmt::format("{}: cannot be renamed to {}: {}", partial_path_, path_, error.message()));
}

namespace {

/// Whether two names lead to one file, there or not yet. Pipes and devices may be shared.
bool isSameFile(const std::string& a, const std::string& b) {
  std::error_code ignored;
  if (fs::exists(a, ignored) || fs::exists(b, ignored)) {
    return fs::is_regular_file(a, ignored) && fs::equivalent(a, b, ignored);
  }
  const auto canonical = [&ignored](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  };
  return canonical(a) == canonical(b);
}

/// The names that are written to.
std::vector<std::string> namesOf(const OutputOption& output) {
  if (output.path.empty() || output.path == "-") return {};
  return {output.path, PartialFile(output.path).path()};
}

bool haveCommonFile(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::any_of(a.begin(), a.end(), [&b](const std::string& name) {
    return std::any_of(b.begin(), b.end(),
                       [&name](const std::string& other) { return isSameFile(name, other); });
  });
}

}  // namespace

void checkOutputs(const std::vector<OutputOption>& outputs,
                  const std::vector<std::string>& inputs) {
  for (const OutputOption& output : outputs) {
    const auto fail = [&output](const std::string& rule) {
      throw std::invalid_argument(fmt::format("{} = {}: {}", output.option, output.path, rule));
    };
    if (haveCommonFile(namesOf(output), inputs)) fail("must not be a file that is read");
    for (const OutputOption& other : outputs) {
      if (&other == &output) break;
      const bool share_standard_output = output.path == "-" && other.path == "-";
      if (share_standard_output || haveCommonFile(namesOf(output), namesOf(other))) {
        fail("must not be what " + other.option + " writes");
      }
    }
  }
}

void OutputFile::Closer::operator()(std::FILE* file) const {
  if (file != stdout) std::fclose(file);
}

OutputFile::OutputFile(const std::string& path) {
  if (path == "-") {
    shown_path_ = "the standard output";
    file_.reset(stdout);
    return;
  }
  partial_ = std::make_unique<PartialFile>(path);
  shown_path_ = partial_->path();
  file_.reset(std::fopen(shown_path_.c_str(), "wb"));
  if (!file_) fail();
}

void OutputFile::fail() const {
  throw std::invalid_argument(
      fmt::format("{}: cannot be written: {}", shown_path_, std::strerror(errno)));
}

void OutputFile::write(const char* data, std::size_t size) {
  if (std::fwrite(data, 1, size, file_.get()) != size) fail();
}

void OutputFile::close() {
  if (std::fflush(file_.get()) != 0) fail();
  std::FILE* file = file_.release();
  if (file != stdout && std::fclose(file) != 0) fail();
  if (partial_) partial_->commit();
}

}  // namespace hovercraft
