# Puts text files into a program, so that it needs no files of its own where it runs.
#
#   farhorizon_embed(TARGET HEADER NAME FILE [NAME FILE]…)
#
# adds to TARGET a source that defines, for each pair, `const std::string_view NAME`, declared in
# HEADER: the bytes of FILE, which is named from the present folder. It is made again when a file
# changes. Requires: no file has the text )embedded".
set(FARHORIZON_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(farhorizon_embed target header)
  string(MAKE_C_IDENTIFIER ${header} name)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}_embedded.cpp)
  set(files "")
  set(pairs "")
  foreach(item IN LISTS ARGN)
    if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${item})
      set(item ${CMAKE_CURRENT_SOURCE_DIR}/${item})
      list(APPEND files ${item})
    endif()
    list(APPEND pairs ${item})
  endforeach()
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} "-DSOURCE=${source}" "-DHEADER=${header}" "-DPAIRS=${pairs}"
      -P ${FARHORIZON_EMBED_SCRIPT}
    DEPENDS ${files} ${FARHORIZON_EMBED_SCRIPT} VERBATIM)
  target_sources(${target} PRIVATE ${source})
endfunction()

if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  set(text "#include \"${HEADER}\"\n\nnamespace farhorizon {\n\n")
  while(PAIRS)
    list(POP_FRONT PAIRS name file)
    file(READ ${file} bytes)
    string(APPEND text "const std::string_view ${name} = R\"embedded(${bytes})embedded\";\n\n")
  endwhile()
  file(WRITE ${SOURCE} "${text}}  // namespace farhorizon\n")
endif()
