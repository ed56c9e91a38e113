from pendula import poincare_section

section = poincare_section(rods, (0.3, 0.1, 0.0, 0.0), angle(1, 0.0, direction=1), 1000)
print(section.states.shape, abs(section.states[:, 0]).max() < 1e-15)
print(section.times[:2], section.states[0, 1:])
