# Embeds the page's style sheet and scripts in the library. uPlot is optional: `npm ci` fetches it.
set(report_folder ${CMAKE_CURRENT_LIST_DIR})
set(uplot_folder ${report_folder}/node_modules/uplot/dist)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  ${report_folder}/page.css ${report_folder}/page.js ${report_folder}/package-lock.json)

file(READ ${report_folder}/page.css IDENT_PAGE_STYLE)
file(READ ${report_folder}/page.js IDENT_PAGE_SCRIPT)
set(IDENT_PLOT_LIBRARY "")
set(IDENT_PLOT_LIBRARY_STYLE "")
if(EXISTS ${uplot_folder}/uPlot.iife.min.js)
  file(READ ${uplot_folder}/uPlot.iife.min.js IDENT_PLOT_LIBRARY)
  file(READ ${uplot_folder}/uPlot.min.css IDENT_PLOT_LIBRARY_STYLE)
else()
  message(STATUS "uPlot not found (npm ci in src/ident/report): reports have static plots")
endif()
configure_file(${report_folder}/assets.cc.in ${PROJECT_BINARY_DIR}/generated/report_assets.cc @ONLY)
target_sources(ident_lib PRIVATE ${PROJECT_BINARY_DIR}/generated/report_assets.cc)
