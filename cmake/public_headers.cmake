# The headers that a program of a user includes: those of the table in doc/api.md (InstalledHeaders.* holds the two against each other), and
# what they include. No other is installed.
#
# hovercraft_install_headers(DESTINATION): installs them there, below the prefix. What they include is looked up when it is installed.

set(hovercraft_public_headers
  body/mass_properties.h body/rigid_body.h body/steppers.h
  geometry/polyhedron_shapes.h geometry/mesh_file.h geometry/convex_hull.h
  collision/closest_features.h collision/time_of_impact.h
  hovercraft/step_inputs.h scenario/world_builder.h
  scenario/scenario_parser.h scenario/version.h
  sim/simulation.h sim/run_observer.h sim/run_outputs.h sim/run.h sim/snapshot.h sim/state_hash.h sim/batch.h
  records/simulate.h records/states_csv.h
  analysis/compare.h bags/trajectory_file.h
  bags/recording_reader.h bags/bag_writer.h bags/replay.h
  clients/flight.h clients/flight_test.h)

function(hovercraft_install_headers destination)
  string(REPLACE ";" " " headers "${hovercraft_public_headers}")
  # Scripts that install know no policies of the project.
  install(CODE "
    cmake_policy(SET CMP0057 NEW)
    set(waiting ${headers})
    set(found)
    while(waiting)
      list(GET waiting 0 header)
      list(REMOVE_AT waiting 0)
      if(header IN_LIST found)
        continue()
      endif()
      list(APPEND found \${header})
      get_filename_component(module \${header} DIRECTORY)
      set(file \"${PROJECT_SOURCE_DIR}/include/hovercraft_sim/\${header}\")
      file(INSTALL \"\${file}\" DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${destination}/\${module}\")
      file(STRINGS \"\${file}\" lines REGEX \"^#include \\\"hovercraft_sim/[a-z]+/[a-z0-9_]+[.]h\\\"\")
      foreach(line IN LISTS lines)
        string(REGEX REPLACE \"^#include \\\"hovercraft_sim/(.*[.]h)\\\".*\" \"\\\\1\" included \"\${line}\")
        list(APPEND waiting \${included})
      endforeach()
    endwhile()")
endfunction()
