capstan_test(NAME registration_guide_test SOURCES registration_guide_test.cpp LINKS capstan::session)
