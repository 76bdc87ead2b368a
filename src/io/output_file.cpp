#include "hovercraft_sim/io/output_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>
#include <sys/stat.h>
#include <unistd.h>

namespace hovercraft {

namespace fs = std::filesystem;

namespace {

constexpr int kMostPartials = 1000;  // that may lie beside a file before no more are made
constexpr mode_t kPrivate = S_IRUSR | S_IWUSR;
constexpr mode_t kUmaskDecides = 0666;
constexpr mode_t kPermissions = 0777;

std::string systemReason() {
  return std::strerror(errno);
}

/// Of the file behind a path, following links; none if there is none.
bool statusOf(const std::string& path, struct stat& status) {
  return ::stat(path.c_str(), &status) == 0;
}

/// Whether the standard output or the standard error goes into the file.
bool isStandardStream(const struct stat& file) {
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat standard {};
    if (::fstat(stream, &standard) == 0 && standard.st_dev == file.st_dev &&
        standard.st_ino == file.st_ino) {
      return true;
    }
  }
  return false;
}

/// Why nothing can be written there; empty if it can.
std::string objectionTo(const std::string& path) {
  if (path.empty()) return "the name is empty";
  if (path.find('\0') != std::string::npos) return "the name holds a NUL";
  struct stat status {};
  if (statusOf(path, status)) {
    if (!S_ISREG(status.st_mode)) {
      return fmt::format("it is {}, must be a regular file or a name that is free",
                         kindOfFile(status.st_mode));
    }
    return isStandardStream(status)
               ? "must not be where the standard output or the standard error goes"
               : "";
  }
  if (::lstat(path.c_str(), &status) == 0 && S_ISLNK(status.st_mode)) {
    return "it is a link that leads nowhere, must be a regular file or a name that is free";
  }
  return path.back() == '/' ? "it is the name of a directory" : "";
}

}  // namespace

PartialFile::PartialFile(const std::string& path) : path_(path) {
  std::string objection = objectionTo(path);
  if (!objection.empty()) fail(objection);
  struct stat status {};
  replaces_ = statusOf(path, status);
  if (replaces_) {
    std::error_code error;
    path_ = fs::canonical(path, error).string();  // behind a link, so that the link stays one
    if (error) {
      path_ = path;
      fail(error.message());
    }
    // To replace a file takes no leave of its own; who took it away meant it.
    if (::faccessat(AT_FDCWD, path_.c_str(), W_OK, AT_EACCESS) != 0) fail(systemReason());
  }
  const fs::path parent = fs::path(path_).parent_path();
  name_ = fs::path(path_).filename().string();
  folder_ =
      Descriptor(::open(parent.empty() ? "." : parent.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!folder_.isOpen()) fail(systemReason());
  create();
}

/// A file of its own under the first name that is free. What it replaces may be secret, so until
/// then nobody else reads it.
void PartialFile::create() {
  const mode_t mode = replaces_ ? kPrivate : kUmaskDecides;
  for (int i = 1; i <= kMostPartials; ++i) {
    const std::string end = i == 1 ? ".partial" : fmt::format(".partial.{}", i);
    partial_name_ = name_ + end;
    file_ = Descriptor(::openat(folder_.number(), partial_name_.c_str(),
                                O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode));
    if (file_.isOpen()) {
      partial_path_ = path_ + end;
      return;
    }
    if (errno != EEXIST) fail(systemReason());
  }
  fail(fmt::format("there are {} partial files beside it already", kMostPartials));
}

PartialFile::~PartialFile() {
  struct stat status {};
  if (file_.isOpen() && ::fstat(file_.number(), &status) == 0 && status.st_size == 0) discard();
}

std::string PartialFile::openablePath() const {
  const std::string itself = fmt::format("/proc/self/fd/{}", file_.number());
  return ::access(itself.c_str(), W_OK) == 0 ? itself : partial_path_;
}

void PartialFile::keepModeAndOwner() const {
  struct stat replaced {};
  if (::fstatat(folder_.number(), name_.c_str(), &replaced, AT_SYMLINK_NOFOLLOW) != 0) {
    if (errno != ENOENT) fail(systemReason());
    return;
  }
  if (!S_ISREG(replaced.st_mode)) {
    fail(fmt::format("it has become {} meanwhile", kindOfFile(replaced.st_mode)));
  }
  if (!replaces_) return;
  struct stat own {};
  if (::fstat(file_.number(), &own) != 0) fail(systemReason());
  const bool is_of_another = own.st_uid != replaced.st_uid || own.st_gid != replaced.st_gid;
  // Only root may give a file away; others keep what they have replaced as their own.
  if (is_of_another && ::fchown(file_.number(), replaced.st_uid, replaced.st_gid) != 0 &&
      errno != EPERM) {
    fail(systemReason());
  }
  if (::fchmod(file_.number(), replaced.st_mode & kPermissions) != 0) fail(systemReason());
}

/// Whether the partial name still leads to the file that was made.
bool PartialFile::isStillThere() const {
  struct stat own {};
  struct stat named {};
  return ::fstat(file_.number(), &own) == 0 &&
         ::fstatat(folder_.number(), partial_name_.c_str(), &named, AT_SYMLINK_NOFOLLOW) == 0 &&
         own.st_dev == named.st_dev && own.st_ino == named.st_ino;
}

void PartialFile::commit() {
  keepModeAndOwner();
  // Some file systems have nothing to bring to the disk: EINVAL.
  if (::fsync(file_.number()) != 0 && errno != EINVAL) fail(systemReason());
  if (!isStillThere()) fail(partial_path_ + " was moved away or replaced meanwhile");
  if (::renameat(folder_.number(), partial_name_.c_str(), folder_.number(), name_.c_str()) != 0) {
    fail(fmt::format("{} cannot be renamed to it: {}", partial_path_, systemReason()));
  }
  file_ = Descriptor();
  // The name is there now, so what the folder's disk answers changes nothing.
  const Descriptor folder(::openat(folder_.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.isOpen()) ::fsync(folder.number());
}

void PartialFile::discard() {
  if (file_.isOpen() && isStillThere()) ::unlinkat(folder_.number(), partial_name_.c_str(), 0);
  file_ = Descriptor();
}

void PartialFile::fail(const std::string& reason) const {
  throw std::invalid_argument(fmt::format("{}: cannot be written: {}", path_.c_str(), reason));
}

namespace {

/// Whether two names lead to one file, there or not yet.
bool isSameFile(const std::string& a, const std::string& b) {
  std::error_code ignored;
  if (fs::exists(a, ignored) || fs::exists(b, ignored)) return fs::equivalent(a, b, ignored);
  const auto canonical = [&ignored](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  };
  return canonical(a) == canonical(b);
}

/// Whether one output is the other, or has the name that the other bears until it is whole.
bool clash(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  if (a == "-" || b == "-") return a == b;
  return isSameFile(a, b) || isSameFile(a + ".partial", b) || isSameFile(a, b + ".partial");
}

/// What is wrong with an output by itself or beside what is read, or nothing.
std::string objectionTo(const std::string& path, const std::vector<std::string>& inputs) {
  if (path.empty() || path == "-") return "";
  const auto is_output = [&path](const std::string& input) {
    return !input.empty() && isSameFile(path, input);
  };
  if (std::any_of(inputs.begin(), inputs.end(), is_output)) {
    return "must not be a file that is read";
  }
  const std::string objection = objectionTo(path);
  struct stat status {};
  const bool is_stream =
      statusOf(path, status) && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
  return is_stream ? objection + " (- is the standard output)" : objection;
}

}  // namespace

void checkOutputs(const std::vector<OutputOption>& outputs,
                  const std::vector<std::string>& inputs) {
  for (const OutputOption& output : outputs) {
    const auto fail = [&output](const std::string& rule) {
      throw std::invalid_argument(fmt::format("{} = {}: {}", output.option, output.path, rule));
    };
    for (const OutputOption& other : outputs) {
      if (&other == &output) break;
      if (clash(output.path, other.path)) fail("must not be what " + other.option + " writes");
    }
    const std::string objection = objectionTo(output.path, inputs);
    if (!objection.empty()) fail(objection);
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
  Descriptor copy(::fcntl(partial_->descriptor(), F_DUPFD_CLOEXEC, 0));
  if (!copy.isOpen()) fail();
  file_.reset(::fdopen(copy.number(), "wb"));
  if (!file_) fail();
  copy.release();
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

void writeWholeFile(const std::string& path, const std::string& text) {
  PartialFile partial(path);
  try {
    std::size_t written = 0;
    while (written < text.size()) {
      const ssize_t count =
          ::write(partial.descriptor(), text.data() + written, text.size() - written);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) {
        throw std::invalid_argument(fmt::format("{}: cannot be written: {}", path, systemReason()));
      }
      written += static_cast<std::size_t>(count);
    }
    partial.commit();
  } catch (const std::invalid_argument&) {
    partial.discard();
    throw;
  }
}

}  // namespace hovercraft
