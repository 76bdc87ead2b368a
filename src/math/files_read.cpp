#include "hovercraft_sim/math/files_read.h"

namespace hovercraft {
namespace {

thread_local FilesRead* innermost = nullptr;

}  // namespace

FilesRead::FilesRead() : outer_(innermost) {
  innermost = this;
}

FilesRead::~FilesRead() {
  innermost = outer_;
}

void FilesRead::note(const std::string& path) {
  for (FilesRead* each = innermost; each != nullptr; each = each->outer_) {
    each->paths_.push_back(path);
  }
}

}  // namespace hovercraft
