"""What a picture is made from: meshes in their places, lights, a camera, a background."""
