# libpcap as the target libpcap_library.
find_path(Libpcap_INCLUDE_DIR pcap/pcap.h)
find_library(Libpcap_LIBRARY pcap)
mark_as_advanced(Libpcap_INCLUDE_DIR Libpcap_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Libpcap REQUIRED_VARS Libpcap_LIBRARY Libpcap_INCLUDE_DIR)
if(Libpcap_FOUND AND NOT TARGET libpcap_library)
  add_library(libpcap_library INTERFACE IMPORTED)
  target_link_libraries(libpcap_library INTERFACE ${Libpcap_LIBRARY})
  target_include_directories(libpcap_library SYSTEM INTERFACE ${Libpcap_INCLUDE_DIR})
endif()
