#pragma once

#include <algorithm>
#include <memory>
#include <mujoco/mujoco.h>
#include <stdexcept>
#include <string>

namespace hovercraft::bench {

/// @param xml the text of a model. @returns what mj_deleteModel() must delete.
inline mjModel* loadMujoco(const std::string& xml) {
  constexpr int error_size = 1000;  // characters, as in MuJoCo's samples
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  const char* name = "scene.xml";
  mj_makeEmptyFileVFS(files.get(), name, static_cast<int>(xml.size()));
  std::copy(xml.begin(), xml.end(),
            static_cast<char*>(files->filedata[mj_findFileVFS(files.get(), name)]));
  std::string error(error_size, '\0');
  mjModel* model = mj_loadXML(name, files.get(), &error[0], error_size);
  mj_deleteVFS(files.get());
  if (model == nullptr) throw std::logic_error("MuJoCo refused the model: " + error);
  return model;
}

/// A model and its state.
class MujocoWorld {
 public:
  explicit MujocoWorld(const std::string& xml)
      : model_(loadMujoco(xml)), data_(mj_makeData(model_)) {}
  ~MujocoWorld() {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  MujocoWorld(const MujocoWorld&) = delete;
  MujocoWorld& operator=(const MujocoWorld&) = delete;

  mjData& data() const { return *data_; }
  void forward() { mj_forward(model_, data_); }
  void step() { mj_step(model_, data_); }

 private:
  mjModel* model_;
  mjData* data_;
};

}  // namespace hovercraft::bench
