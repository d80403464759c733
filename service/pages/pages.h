#pragma once

#include <string>
#include <string_view>

namespace farhorizon {

/// The page at "/", for a browser: jobs, and where to drop a DEM. Its addresses are relative, so
/// that it works below any prefix that a proxy puts before it.
std::string IndexPage();

/// What a browser is shown at "/viewer/ID" where there is no such job. why: a sentence.
std::string NoJobPage(const std::string& why);

/// What a page of the viewer shows.
///
/// results: where the artifacts are, with a slash at its end, or empty: beside the page.
/// cesium: where CesiumJS is, without a slash at its end; empty: it is not installed.
/// home: where the list of jobs is; empty: there is none.
struct ViewerPlaces {
  std::string results;
  std::string cesium;
  std::string home;
};

/// The page at "/viewer/ID", whose scripts are files of the service.
std::string ViewerPage(const ViewerPlaces& places);

/// The same page in one file, with its scripts within, for any web server.
std::string StandaloneViewer(const ViewerPlaces& places);

/// A script or style of the pages by its name, "viewer.js"; empty where there is none.
std::string_view PageFile(std::string_view name);

/// 16 hexadecimal digits of the hash of all scripts and styles, for their address.
const std::string& PageFingerprint();

}  // namespace farhorizon
