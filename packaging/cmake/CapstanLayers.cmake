# Adds the folders of layers.txt beside the calling CMakeLists.txt, lowest first. tests/architecture reads the same file
# and holds includes and links to it; `tests/architecture/include_graph` prints what comes of it.
macro(capstan_layers)
  file(STRINGS layers.txt layers REGEX "^[^#]")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS layers.txt)
  foreach(layer IN LISTS layers)
    string(REPLACE " " ";" folders "${layer}")
    foreach(folder IN LISTS folders)
      add_subdirectory(${folder})
    endforeach()
  endforeach()
endmacro()
