# The pages in adapters/web/, bundled by Node into one file each; empty where there is no npm, and the program
# says so when it is asked for one.
set(LIMPET_PAGES "" CACHE PATH "a folder with pages that adapters/web/build has made, for a machine without Node")
if(LIMPET_PAGES)
  set(LIMPET_VIEW_PAGE ${LIMPET_PAGES}/view.html)
  return()
endif()
set(LIMPET_VIEW_PAGE ${CMAKE_BINARY_DIR}/web/view.html)
limpet_files(web_sources ${LIMPET_ROOT}/adapters/web/src/*)
add_custom_command(
  OUTPUT ${LIMPET_VIEW_PAGE}
  COMMAND ${LIMPET_ROOT}/adapters/web/build ${CMAKE_BINARY_DIR}/web
  DEPENDS ${web_sources} ${LIMPET_ROOT}/adapters/web/build ${LIMPET_ROOT}/adapters/web/build.mjs ${LIMPET_ROOT}/adapters/web/package-lock.json
  COMMENT "Bundling the pages")
