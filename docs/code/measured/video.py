import pendula
from pendula.measured import fit, read, with_uncertainty

video = read("video.csv", as_angle=True)
print(video.notes[-1])
found = fit(video, "viscous")
print(with_uncertainty(*found["gravity"]))
found.save("video.json")  # with the recording and what was asked | con el registro y lo pedido
again = pendula.rerun("video.json")
print((again.values == found.values).all(), pendula.load("video.json").names)
