#include "hovercraft_sim/report/report.h"

#include <boost/program_options.hpp>
#include <exception>
#include <iostream>
#include <unistd.h>

#include "hovercraft_sim/scenario/version.h"

int main(int argc, char** argv) {
  namespace po = boost::program_options;
  try {
    hovercraft_ros::ReportRequest request;
    po::options_description options("Options");
    auto add = options.add_options();
    add("bag", po::value(&request.bag)->required(),
        "recording of the node, bag of simulate, or any");
    add("other", po::value(&request.other), "a second one, laid over it");
    add("output,o", po::value(&request.output)->default_value(request.output),
        "the page (.html); - is the standard output");
    add("png", po::value(&request.png), "folder for the plots as pictures");
    add("svg", po::value(&request.svg), "folder for the plots as drawings");
    add("help,h", "this text");
    add("version", "of the package, and of the physics");
    po::positional_options_description positions;
    positions.add("bag", 1).add("other", 1);
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(options).positional(positions).run(),
              values);
    if (values.count("help") > 0) {
      std::cout << "report RUN.bag [OTHER.bag] [--output report.html] [--png DIR] [--svg DIR]\n"
                   "Makes a page of a bag that any browser opens: the way, the craft in three "
                   "dimensions,\nspeeds, thrusts, contacts, energy. Of two bags also where and by "
                   "how much they differ.\n\n"
                << options;
      return 0;
    }
    if (values.count("version") > 0) {
      std::cout << hovercraft::versionText("report") << '\n';
      return 0;
    }
    po::notify(values);
    request.shows_progress = isatty(STDERR_FILENO) != 0;
    const std::string made = makeReport(request, std::cerr);
    (request.output == "-" ? std::cerr : std::cout) << made << '\n';
  } catch (const std::exception& error) {
    std::cerr << "report: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
