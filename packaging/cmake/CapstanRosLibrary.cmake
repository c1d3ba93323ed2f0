# The part of core/ros1 that calls ROS, as a shared library in two editions: one that throws errors (beside the programs)
# and one that links ROS (component capstan-ros, in the folder ros). Programs search the folder ros first, so that ROS is
# added by installing one file and programs do not depend on it otherwise.
set(sources bag_export.cpp message_codec.cpp ros_node.cpp ros_topics.cpp)
list(TRANSFORM sources PREPEND core/ros1/)
set_source_files_properties(core/ros1/message_codec.cpp core/ros1/ros_node.cpp core/ros1/ros_topics.cpp
                            PROPERTIES COMPILE_OPTIONS -std=c++17)  # as in core/ros1
add_library(capstan_ros1_none SHARED core/ros1/without_ros.cpp)
add_library(capstan_ros1_system SHARED ${sources})
target_link_libraries(capstan_ros1_system PRIVATE capstan_ros_libraries)

# The build folder has the layout of the installed files, seen from app/cli and app/workstation: run paths do not depend
# on the folder of the build.
set(library_folder ${CMAKE_INSTALL_LIBDIR}/capstan)
set(folder_none ${library_folder})
set(folder_system ${library_folder}/ros)
foreach(edition none system)
  target_link_libraries(capstan_ros1_${edition} PRIVATE capstan::ros1 capstan_options)
  target_link_options(capstan_ros1_${edition} PRIVATE LINKER:--exclude-libs,ALL)  # exports its own functions alone
  set_target_properties(capstan_ros1_${edition} PROPERTIES
    OUTPUT_NAME capstan-ros1 LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/app/${folder_${edition}}
    BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "")
endforeach()

# The shared library precedes the archives on the command line: capstan::ros1 has the same functions, without ROS.
foreach(program capstan capstan-cli)
  add_dependencies(${program} capstan_ros1_none)
  target_link_options(${program} PRIVATE LINKER:--push-state,--no-as-needed $<TARGET_FILE:capstan_ros1_none> LINKER:--pop-state)
  set_target_properties(${program} PROPERTIES
    LINK_DEPENDS $<TARGET_FILE:capstan_ros1_none> BUILD_WITH_INSTALL_RPATH ON
    INSTALL_RPATH "$ORIGIN/../${library_folder}/ros;$ORIGIN/../${library_folder}")
endforeach()

install(TARGETS capstan_ros1_none LIBRARY DESTINATION ${folder_none} COMPONENT capstan-cli)
install(TARGETS capstan_ros1_system LIBRARY DESTINATION ${folder_system} COMPONENT capstan-ros)
