# Embeds the page's style sheets and scripts in the library. uPlot is optional: `npm ci` fetches it.
set(report_folder ${CMAKE_CURRENT_LIST_DIR})

# Reads a file into a variable; the build is configured again when the file changes.
function(ident_asset variable file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${report_folder}/${file})
  file(READ ${report_folder}/${file} content)
  set(${variable} "${content}" PARENT_SCOPE)
endfunction()

ident_asset(IDENT_LIGHT_COLOURS light.css)
ident_asset(IDENT_DARK_COLOURS dark.css)
ident_asset(IDENT_PLOT_STYLE plot.css)
ident_asset(IDENT_PAGE_STYLE page.css)
ident_asset(IDENT_PAGE_SCRIPT page.js)
set(uplot node_modules/uplot/dist)
if(EXISTS ${report_folder}/${uplot}/uPlot.iife.min.js)
  ident_asset(IDENT_PLOT_LIBRARY ${uplot}/uPlot.iife.min.js)
  ident_asset(IDENT_PLOT_LIBRARY_STYLE ${uplot}/uPlot.min.css)
else()
  message(STATUS "uPlot not found (npm ci in src/ident/report fetches it): reports get static plots")
endif()
configure_file(${report_folder}/assets.cc.in ${PROJECT_BINARY_DIR}/generated/report_assets.cc @ONLY)
target_sources(ident_lib PRIVATE ${PROJECT_BINARY_DIR}/generated/report_assets.cc)
